#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {
namespace {

template <class Joinable>
void join_greedily(std::vector<geometry::Point2>& path, const Joinable& are_joinable) {
  if (path.size() < 3) return;
  std::size_t kept = 1;
  for (std::size_t next = 1; next + 1 < path.size(); ++next) {
    if (!are_joinable(path[kept - 1], path[next + 1])) path[kept++] = path[next];
  }
  path[kept++] = path.back();
  path.resize(kept);
}

}  // namespace

void greedy_line_of_sight(const Drivable& drivable, std::vector<geometry::Point2>& path) {
  join_greedily(path, [&](geometry::Point2 a, geometry::Point2 b) { return drivable.is_line_free(a, b); });
}

void safe_distance(const Drivable& drivable, std::vector<geometry::Point2>& path) {
  for (std::size_t before = 0; before != path.size();) {
    before = path.size();
    join_greedily(path, [&](geometry::Point2 a, geometry::Point2 b) { return drivable.is_line_safe(a, b); });
  }
}

}  // namespace aisle::global_planner::passes
