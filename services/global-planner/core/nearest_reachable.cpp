#include "services/global-planner/core/nearest_reachable.hpp"

#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

std::optional<geometry::Point2> nearest_reachable(const Problem& problem, const OutOfTime& out_of_time) {
  ConnectedParts parts;
  return nearest_reachable(problem, parts, out_of_time);
}

std::optional<geometry::Point2> nearest_reachable(const Problem& problem, ConnectedParts& parts,
                                                  const OutOfTime& out_of_time) {
  const grid::Geometry& geometry = problem.clearance.geometry();
  if (!is_in_map(geometry, problem.start_in_map) || (out_of_time && out_of_time())) return {};

  parts.make(Drivable(problem));
  const std::optional<grid::Cell> cell = parts.nearest(geometry.cell_at(problem.start_in_map), problem.goal_in_map);

  return cell ? std::optional(geometry.center_in_map(*cell)) : std::nullopt;
}

PlannedPath plan_to_nearest(Planner& planner, const Problem& problem, const OutOfTime& out_of_time) {
  PlannedPath plan = planner.plan(problem, out_of_time);
  if (plan.outcome != Outcome::kNoPath && plan.outcome != Outcome::kGoalBlocked) return plan;

  const std::optional<geometry::Point2> point = nearest_reachable(problem, out_of_time);
  if (!point) return plan;

  Problem nearer = problem;
  nearer.goal_in_map = *point;

  PlannedPath to_nearest = planner.plan(nearer, out_of_time);

  return to_nearest.outcome == Outcome::kFound ? to_nearest : plan;
}

}  // namespace aisle::global_planner
