#include <cstdlib>

#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {

void right_angle(const Drivable& drivable, std::vector<geometry::Point2>& path) {
  if (path.size() < 3) return;
  const auto are_neighbours = [&](geometry::Point2 a, geometry::Point2 b) {
    const grid::Cell from = drivable.geometry().cell_at(a);
    const grid::Cell to = drivable.geometry().cell_at(b);
    return std::abs(from.x - to.x) <= 1 && std::abs(from.y - to.y) <= 1;
  };
  std::size_t kept = 1;
  for (std::size_t next = 1; next + 1 < path.size(); ++next) {
    const bool is_needless =
        are_neighbours(path[kept - 1], path[next + 1]) && drivable.is_line_free(path[kept - 1], path[next + 1]);
    if (!is_needless) path[kept++] = path[next];
  }
  path[kept++] = path.back();
  path.resize(kept);
}

}  // namespace aisle::global_planner::passes
