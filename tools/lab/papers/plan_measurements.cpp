#include "tools/lab/papers/plan_measurements.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "services/global-planner/core/path_figures.hpp"
#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/ompl_planners.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using global_planner::Heuristic;
using global_planner::Moves;
using global_planner::PlannedPath;
using global_planner::Planner;
using global_planner::Problem;

constexpr const char* kWithoutPasses = "-without-passes";
constexpr const char* kOptimum = "astar";  // whose length is the grid's optimum

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Map kinds that a row of the papers names, with commas between.
std::vector<std::string> split_kinds(const std::string& kinds) {
  std::vector<std::string> names;
  std::istringstream in(kinds);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

/// All planners that the papers' tables have on maps of this kind.
std::set<std::string> planners_on(const std::string& map_kind) {
  std::set<std::string> names{kOptimum};
  for (const PublishedRow& row : published_rows()) {
    const auto* evidence = std::get_if<PlanEvidence>(&row.evidence);
    if (evidence == nullptr) continue;
    const std::vector<std::string> kinds = split_kinds(evidence->map);
    if (std::find(kinds.begin(), kinds.end(), map_kind) == kinds.end()) continue;
    names.insert(evidence->planner);
    if (evidence->reference != nullptr) names.insert(evidence->reference);
  }
  return names;
}

double seconds_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

PlannedPath timed(Planner& planner, const Problem& problem, double& least_us) {
  PlannedPath plan;
  least_us = 1e300;
  for (int run = 0; run < kTimedRuns; ++run) {
    const auto begun = std::chrono::steady_clock::now();
    plan = planner.plan(problem, nullptr);
    least_us = std::min(least_us, 1e6 * seconds_since(begun));
    if (run > 0 && least_us > kLongPlanUs) break;  // ants, samples; one long run alone may have been interrupted
  }
  return plan;
}

/// One map's figures behind the others'.
void add(const PlannedPath& plan, const grid::ClearanceField& clearance, double time_us, PlanFigures& figures) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const bool is_found = plan.outcome == global_planner::Outcome::kFound;
  const global_planner::PathFigures path = global_planner::path_figures(clearance, plan.waypoints_in_map);
  const auto put = [&](PlanFigure figure, double value) { figures[figure].push_back(is_found ? value : kNothing); };

  put(PlanFigure::kLength, path.length_m);
  put(PlanFigure::kNodes, path.nodes);
  put(PlanFigure::kTurns, path.turning_points);
  put(PlanFigure::kTurned, path.turning_angle_rad);
  put(PlanFigure::kExpanded, static_cast<double>(plan.expanded));
  put(PlanFigure::kTime, time_us);
  put(PlanFigure::kClearance, path.least_clearance_m);
}

/// The papers' planners find a path on every map that paper_map() draws.
void refuse_gaps(const std::map<std::string, PlanFigures>& measured, const std::string& map_kind, const MapDraw& draw) {
  for (const auto& [name, figures] : measured) {
    const std::vector<double>& lengths_m = figures.at(PlanFigure::kLength);
    for (std::size_t i = 0; i < lengths_m.size(); ++i)
      if (std::isnan(lengths_m[i]))
        throw std::logic_error(name + " finds no path on map " + std::to_string(draw.first() + i) + " of " + map_kind);
  }
}

void compare_with_optimum(std::map<std::string, PlanFigures>& measured) {
  const std::vector<double> optimum_m = measured.at(kOptimum).at(PlanFigure::kLength);
  for (auto& [name, figures] : measured)
    for (std::size_t i = 0; i < optimum_m.size(); ++i)
      figures[PlanFigure::kIsOptimal].push_back(
          figures.at(PlanFigure::kLength)[i] <= optimum_m[i] * (1.0 + 1e-9) ? 1.0 : 0.0);
}

}  // namespace

std::unique_ptr<Planner> plan_contestant(const std::string& name) {
  if (name == "traditional") return global_planner::traditional_astar(Heuristic::kEuclidean);
  if (name == "traditional-chebyshev") return global_planner::traditional_astar(Heuristic::kChebyshev);
  if (name == "traditional-four") return global_planner::traditional_astar(Heuristic::kEuclidean, Moves::kFour);
  if (is_ompl_planner(name)) {
    SamplingBounds bounds;
    bounds.iterations = kSamplingIterations;
    return ompl_planner(name, bounds);
  }
  if (!ends_with(name, kWithoutPasses)) return global_planner::find_variant(name)->make();
  global_planner::Parameters bare;
  bare.set("passes", "none");
  return global_planner::find_variant(name.substr(0, name.size() - std::string(kWithoutPasses).size()))->make(bare);
}

std::vector<std::string> plan_contestant_names() {
  std::vector<std::string> names{"traditional", "traditional-chebyshev", "traditional-four"};
  for (const global_planner::Variant& variant : global_planner::all_variants()) names.push_back(variant.name);
  names.insert(names.end(), ompl_planner_names().begin(), ompl_planner_names().end());
  return names;
}

std::map<std::string, PlanFigures> measure_plans(const std::string& map_kind, const std::set<std::string>& names,
                                                 const MapDraw& draw) {
  std::map<std::string, std::unique_ptr<Planner>> planners;
  for (const std::string& name : names) planners[name] = plan_contestant(name);

  std::map<std::string, PlanFigures> measured;
  for (unsigned i = 0; i < static_cast<unsigned>(draw.maps); ++i) {
    const DrawnMap map = paper_map(*find_paper_map_kind(map_kind), draw.first() + i);
    const grid::ClearanceField clearance(map.grid, 10.0);
    Problem problem{clearance, map.start_in_map, map.goal_in_map};
    problem.safe_distance_m = kPapersSafeDistanceM;
    for (const auto& [name, planner] : planners) {
      double time_us = 0.0;
      const PlannedPath plan = timed(*planner, problem, time_us);
      add(plan, clearance, time_us, measured[name]);
    }
  }
  return measured;
}

const std::vector<double>& PlanMeasurements::of(const std::string& map_kind, const std::string& planner,
                                                PlanFigure figure) {
  const auto found = measured_.find(map_kind);
  if (found != measured_.end()) return found->second.at(planner).at(figure);

  progress_("planning on maps of " + map_kind);
  std::map<std::string, PlanFigures> measured = measure_plans(map_kind, planners_on(map_kind), draw_);
  refuse_gaps(measured, map_kind, draw_);
  compare_with_optimum(measured);
  return (measured_[map_kind] = std::move(measured)).at(planner).at(figure);
}

}  // namespace aisle::lab
