#include "tools/lab/papers/plan_measurements.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <sstream>
#include <stdexcept>

#include "services/global-planner/core/path_figures.hpp"
#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using global_planner::Heuristic;
using global_planner::Moves;
using global_planner::PlannedPath;
using global_planner::Planner;
using global_planner::Problem;

constexpr int kTimedRuns = 5;
constexpr double kLongUs = 5000.0;  // a planner that takes longer is timed twice only
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
    if (run > 0 && least_us > kLongUs) break;  // ants; one long run alone may have been interrupted
  }
  return plan;
}

}  // namespace

std::unique_ptr<Planner> plan_contestant(const std::string& name) {
  if (name == "traditional") return global_planner::traditional_astar(Heuristic::kEuclidean);
  if (name == "traditional-chebyshev") return global_planner::traditional_astar(Heuristic::kChebyshev);
  if (name == "traditional-four") return global_planner::traditional_astar(Heuristic::kEuclidean, Moves::kFour);
  if (!ends_with(name, kWithoutPasses)) return global_planner::find_variant(name)->make();
  global_planner::Parameters bare;
  bare.set("passes", "none");
  return global_planner::find_variant(name.substr(0, name.size() - std::string(kWithoutPasses).size()))->make(bare);
}

const std::vector<double>& PlanMeasurements::of(const std::string& map_kind, const std::string& planner,
                                                PlanFigure figure) {
  if (measured_.find(map_kind) == measured_.end()) measure(map_kind);
  return measured_.at(map_kind).at(planner).at(figure);
}

void PlanMeasurements::measure(const std::string& map_kind) {
  progress_("planning on maps of " + map_kind);
  std::map<std::string, std::unique_ptr<Planner>> planners;
  for (const std::string& name : planners_on(map_kind)) planners[name] = plan_contestant(name);

  auto& by_planner = measured_[map_kind];
  for (unsigned i = 0; i < static_cast<unsigned>(draw_.maps); ++i) {
    const DrawnMap map = paper_map(*find_paper_map_kind(map_kind), draw_.first() + i);
    const grid::ClearanceField clearance(map.grid, 10.0);
    Problem problem{clearance, map.start_in_map, map.goal_in_map};
    problem.safe_distance_m = kPapersSafeDistanceM;
    for (const auto& [name, planner] : planners) {
      double time_us = 0.0;
      const PlannedPath plan = timed(*planner, problem, time_us);
      if (plan.outcome != global_planner::Outcome::kFound)
        throw std::logic_error(name + " finds no path on map " + std::to_string(draw_.first() + i) + " of " + map_kind);
      const global_planner::PathFigures path = global_planner::path_figures(clearance, plan.waypoints_in_map);
      Figures& figures = by_planner[name];
      figures[PlanFigure::kLength].push_back(path.length_m);
      figures[PlanFigure::kNodes].push_back(path.nodes);
      figures[PlanFigure::kTurns].push_back(path.turning_points);
      figures[PlanFigure::kTurned].push_back(path.turning_angle_rad);
      figures[PlanFigure::kExpanded].push_back(static_cast<double>(plan.expanded));
      figures[PlanFigure::kTime].push_back(time_us);
      figures[PlanFigure::kClearance].push_back(path.least_clearance_m);
    }
  }

  const std::vector<double>& optimum_m = by_planner.at(kOptimum).at(PlanFigure::kLength);
  for (auto& [name, figures] : by_planner)
    for (std::size_t i = 0; i < optimum_m.size(); ++i)
      figures[PlanFigure::kIsOptimal].push_back(
          figures.at(PlanFigure::kLength)[i] <= optimum_m[i] * (1.0 + 1e-9) ? 1.0 : 0.0);
}

}  // namespace aisle::lab
