#include "services/global-planner/core/planner.hpp"

#include <cmath>
#include <utility>

#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

bool is_in_map(const grid::Geometry& geometry, geometry::Point2 in_map) {
  const geometry::Point2 d = in_map - geometry.origin_in_map;
  return geometry::is_finite(in_map) && d.x >= 0.0 && d.y >= 0.0 && d.x < geometry.width * geometry.resolution_m &&
         d.y < geometry.height * geometry.resolution_m && geometry.contains(geometry.cell_at(in_map));
}

double path_length_m(const std::vector<geometry::Point2>& path) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += geometry::distance(path[i - 1], path[i]);
  return length_m;
}

PlannedPath Planner::blank() {
  PlannedPath plan;
  plan.waypoints_in_map = std::move(spare_);
  plan.waypoints_in_map.clear();

  return plan;
}

PlannedPath Planner::plan(const Problem& problem, const OutOfTime& out_of_time) {
  PlannedPath answer;

  plan(problem, out_of_time, answer);
  return answer;
}

void Planner::plan(const Problem& problem, const OutOfTime& out_of_time, PlannedPath& plan) {
  const grid::Geometry& geometry = problem.clearance.geometry();

  // Keep the larger memory for the next plan.
  if (plan.waypoints_in_map.capacity() > spare_.capacity()) spare_.swap(plan.waypoints_in_map);
  plan = PlannedPath{};

  // Each outcome that needs no search, then the search.
  if (!is_in_map(geometry, problem.start_in_map) || !is_in_map(geometry, problem.goal_in_map) ||
      !std::isfinite(problem.radius_m) || problem.radius_m < 0.0) {
    plan.outcome = Outcome::kOutOfMap;
    return;
  }

  const Drivable drivable(problem);
  const grid::Cell start = geometry.cell_at(problem.start_in_map);
  const grid::Cell goal = geometry.cell_at(problem.goal_in_map);

  if (!drivable.is_free(problem.start_in_map) || !drivable.is_traversable(start)) {
    plan.outcome = Outcome::kStartBlocked;
  } else if (!drivable.is_free(problem.goal_in_map) || !drivable.is_traversable(goal)) {
    plan.outcome = Outcome::kGoalBlocked;
  } else if (start == goal) {
    plan.outcome = Outcome::kFound;
    plan.waypoints_in_map = {problem.start_in_map, problem.goal_in_map};
  } else {
    plan = search(problem, drivable, out_of_time);
  }

  plan.length_m = path_length_m(plan.waypoints_in_map);
}

}  // namespace aisle::global_planner
