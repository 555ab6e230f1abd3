#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {

void greedy_line_of_sight(const Drivable& drivable, std::vector<geometry::Point2>& path) {
  if (path.size() < 3) return;
  std::size_t kept = 1;
  for (std::size_t next = 1; next + 1 < path.size(); ++next) {
    if (!drivable.is_line_free(path[kept - 1], path[next + 1])) path[kept++] = path[next];
  }
  path[kept++] = path.back();
  path.resize(kept);
}

}  // namespace aisle::global_planner::passes
