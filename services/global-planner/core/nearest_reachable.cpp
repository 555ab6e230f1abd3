#include "services/global-planner/core/nearest_reachable.hpp"

#include <array>
#include <limits>

#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

std::optional<geometry::Point2> nearest_reachable(const Problem& problem, const OutOfTime& out_of_time) {
  const grid::Geometry& geometry = problem.clearance.geometry();
  const grid::Cell start = geometry.cell_at(problem.start_in_map);
  if (!geometry.contains(start)) return {};
  const Drivable drivable(problem);
  if (!drivable.is_traversable(start)) return {};

  // A diagonal step needs both orthogonal ones, so orthogonal steps alone reach the same cells.
  constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  std::vector<bool> is_seen(geometry.cells(), false);
  std::vector<grid::Cell> open{start};
  is_seen[geometry.index(start)] = true;
  geometry::Point2 nearest = geometry.center_in_map(start);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t looked_at = 0; !open.empty(); ++looked_at) {
    if (looked_at % 1024 == 0 && out_of_time && out_of_time()) return {};
    const grid::Cell cell = open.back();
    open.pop_back();
    const geometry::Point2 center = geometry.center_in_map(cell);
    const double distance_m = geometry::distance(center, problem.goal_in_map);
    if (distance_m < nearest_m) {
      nearest_m = distance_m;
      nearest = center;
    }
    for (const auto& [dx, dy] : kSides) {
      const grid::Cell next{cell.x + dx, cell.y + dy};
      if (!drivable.is_traversable(next) || is_seen[geometry.index(next)]) continue;
      is_seen[geometry.index(next)] = true;
      open.push_back(next);
    }
  }
  return nearest;
}

Plan plan_to_nearest(Planner& planner, const Problem& problem, const OutOfTime& out_of_time) {
  Plan plan = planner.plan(problem, out_of_time);
  if (plan.outcome != Outcome::kNoPath && plan.outcome != Outcome::kGoalBlocked) return plan;
  const std::optional<geometry::Point2> point = nearest_reachable(problem, out_of_time);
  if (!point) return plan;
  Problem nearer = problem;
  nearer.goal_in_map = *point;
  Plan to_nearest = planner.plan(nearer, out_of_time);
  return to_nearest.outcome == Outcome::kFound ? to_nearest : plan;
}

}  // namespace aisle::global_planner
