#include "services/global-planner/core/path_checker.hpp"

#include <algorithm>
#include <cstdio>

namespace aisle::global_planner {
namespace {

using geometry::Point2;

std::string at(const char* what, Point2 p) {
  char text[160];
  std::snprintf(text, sizeof text, "%s at (%.3f, %.3f)", what, p.x, p.y);
  return text;
}

/// The radius that a point of the path must keep: smaller near a start or goal that is itself too near to something.
double radius_at(const Problem& problem, Point2 in_map) {
  double radius_m = problem.radius_m;
  for (const Point2 end : {problem.start_in_map, problem.goal_in_map}) {
    const grid::Cell cell = problem.clearance.geometry().cell_at(end);
    const double end_m = std::min(problem.clearance.clearance_m(end), problem.clearance.clearance_m(cell));
    if (end_m >= problem.least_radius_m && geometry::distance(in_map, end) <= problem.tight_range_m) radius_m = std::min(radius_m, end_m);
  }
  return radius_m;
}

/// What interpolation between cell centres may understate, see ClearanceField::clearance_m.
constexpr double kInterpolation_cells = 0.12;

}  // namespace

std::string why_not_drivable(const Problem& problem, const std::vector<Point2>& path) {
  const double cell_m = problem.clearance.geometry().resolution_m;
  if (path.size() < 2) return "fewer than two points";
  if (path.front() != problem.start_in_map) return at("does not begin at the start, but", path.front());
  if (path.back() != problem.goal_in_map) return at("does not end at the goal, but", path.back());
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!geometry::is_finite(path[i])) return "has a point that is not finite";
    const int pieces = 1 + static_cast<int>(10.0 * geometry::distance(path[i - 1], path[i]) / cell_m);
    for (int k = 0; k <= pieces; ++k) {
      const Point2 p = path[i - 1] + (static_cast<double>(k) / pieces) * (path[i] - path[i - 1]);
      const double clearance_m = problem.clearance.clearance_m(p);
      if (clearance_m <= 0.0) return at("touches an obstacle", p);
      if (clearance_m < radius_at(problem, p) - kInterpolation_cells * cell_m) return at("comes too near to an obstacle", p);
    }
  }
  return {};
}

}  // namespace aisle::global_planner
