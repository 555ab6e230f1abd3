#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {

void collinear(const Drivable& drivable, std::vector<geometry::Point2>& path) {
  if (path.size() < 3) return;
  const double tolerance_m = 1e-6 * drivable.geometry().resolution_m;   // cell centres are exact but for rounding
  std::size_t kept = 1;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const geometry::Point2 before = path[i] - path[kept - 1];
    const geometry::Point2 after = path[i + 1] - path[i];
    const bool is_straight = std::abs(geometry::cross(before, after)) <= tolerance_m * geometry::norm(after) && geometry::dot(before, after) >= 0.0;
    if (!is_straight) path[kept++] = path[i];
  }
  path[kept++] = path.back();
  path.resize(kept);
}

}  // namespace aisle::global_planner::passes
