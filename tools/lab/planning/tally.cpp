#include "tools/lab/planning/tally.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace aisle::lab {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // nothing was solved

}  // namespace

/// Only the planning is timed.
Answer ask(global_planner::Planner& planner, const global_planner::Problem& problem,
           const global_planner::Outline& outline) {
  Answer answer;
  const auto begun = std::chrono::steady_clock::now();

  answer.plan = planner.plan(problem, nullptr);
  answer.time_us = 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();

  if (answer.plan.outcome != global_planner::Outcome::kFound) return answer;

  answer.figures = global_planner::path_figures(problem.clearance, answer.plan.waypoints_in_map);
  answer.fault = global_planner::why_not_drivable(problem, answer.plan, outline);

  return answer;
}

/// Figures are kept of solved queries only.
void Tally::add(const Answer& answer, double optimum_m) {
  ++asked_;
  time_us_.push_back(answer.time_us);

  if (answer.plan.outcome != global_planner::Outcome::kFound) return;

  ++solved_;

  if (!answer.fault.empty()) {
    if (checker_failures_++ == 0) first_fault_ = answer.fault;
  }

  if (optimum_m > 0.0) ratio_.push_back(answer.figures.length_m / optimum_m);
  length_m_.push_back(answer.figures.length_m);
  nodes_.push_back(answer.figures.nodes);
  turning_points_.push_back(answer.figures.turning_points);
  turning_angle_rad_.push_back(answer.figures.turning_angle_rad);
  expanded_.push_back(static_cast<double>(answer.plan.expanded));
  least_clearance_m_ =
      solved_ == 1 ? answer.figures.least_clearance_m : std::min(least_clearance_m_, answer.figures.least_clearance_m);
}

double Tally::length_ratio_max() const {
  return ratio_.empty() ? kNothing : *std::max_element(ratio_.begin(), ratio_.end());
}

double Tally::mean(const std::vector<double>& of) {
  return of.empty() ? kNothing : std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(of.size());
}

double Tally::quantile(std::vector<double> of, double part) {
  if (of.empty()) return kNothing;
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(part * static_cast<double>(of.size())))) - 1;
  std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(rank), of.end());
  return of[rank];
}

}  // namespace aisle::lab
