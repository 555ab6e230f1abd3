#include "services/local-planner/core/room.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {

using geometry::Point2;

namespace {
constexpr double kMostSpareM = 1.0;  // more is not told
constexpr double kLookStepM = 0.05;  // along a line
}  // namespace

double Room::spare_m(Point2 p) const {
  double spare = std::min(kMostSpareM, clearance.clearance_m(p) - radius_m - wall_margin_m);
  for (const Disc& disc : discs) {
    const double reach = radius_m + disc.radius_m + disc_margin_m + spare;

    // A disc counts only if it is nearer than what is left to spare so far: compare squares first.
    const Point2 d = p - disc.position;
    if (geometry::dot(d, d) < reach * reach || reach < 0.0)
      spare = std::min(spare, geometry::norm(d) - radius_m - disc.radius_m - disc_margin_m);
  }

  return spare;
}

bool Room::is_line_free(Point2 a, Point2 b) const {
  const int pieces = std::max(1, static_cast<int>(std::ceil(geometry::distance(a, b) / kLookStepM)));

  for (int i = 0; i <= pieces; ++i)
    if (spare_m(a + (static_cast<double>(i) / pieces) * (b - a)) < 0.0) return false;

  return true;
}

}  // namespace aisle::local_planner
