#include <cmath>

#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {
namespace {

using geometry::Point2;

bool is_straight(Point2 a, Point2 b, Point2 c, double tolerance_m) {
  const Point2 before = b - a;
  const Point2 after = c - b;
  return std::abs(geometry::cross(before, after)) <= tolerance_m * geometry::norm(after) &&
         geometry::dot(before, after) >= 0.0;
}

/// Keeps the ends, what turns, and the first point of each straight run that `may_stay`.
template <class MayStay>
void drop_straight(const Drivable& drivable, std::vector<Point2>& path, const MayStay& may_stay) {
  if (path.size() < 3) return;
  const double tolerance_m = 1e-6 * drivable.geometry().resolution_m;  // cell centres are exact but for rounding
  std::size_t kept = 1;
  bool has_one_in_run = false;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const bool turns = !is_straight(path[kept - 1], path[i], path[i + 1], tolerance_m);
    const bool stays = turns || (!has_one_in_run && may_stay(path[i]));
    if (!stays) continue;
    path[kept++] = path[i];
    has_one_in_run = !turns;
  }
  path[kept++] = path.back();
  path.resize(kept);
}

}  // namespace

void collinear(const Drivable& drivable, std::vector<Point2>& path) {
  drop_straight(drivable, path, [](Point2) { return false; });
}

void collinear_but_one_beside_obstacles(const Drivable& drivable, std::vector<Point2>& path) {
  drop_straight(drivable, path, [&](Point2 p) {
    const grid::Cell cell = drivable.geometry().cell_at(p);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!drivable.is_traversable(grid::Cell{cell.x + dx, cell.y + dy})) return true;
      }
    }
    return false;
  });
}

}  // namespace aisle::global_planner::passes
