#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::geometry {

/// Does the point lie in the polygon, by the even-odd rule? Of a point on an edge it is not said.
///
/// How: a ray to the right crosses the edges an odd number of times from within.
inline bool is_in_polygon(const std::vector<Point2>& corners, Point2 point) {
  bool is_inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Point2 a = corners[i];
    const Point2 b = corners[j];
    if ((a.y > point.y) == (b.y > point.y)) continue;

    const double crossing_x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (point.x < crossing_x) is_inside = !is_inside;
  }

  return is_inside;
}

}  // namespace aisle::geometry
