#include "common/grid/polygon_cells.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/polygon.hpp"

namespace aisle::grid {
namespace {

using geometry::Point2;

/// Does the segment touch the square around a centre?
///
/// How: separating axes; those of the square, and the normal of the segment.
bool touches_square(Point2 centre, double half_m, Point2 a, Point2 b) {
  const auto apart = [&](double from, double to, double middle) {
    return std::min(from, to) > middle + half_m || std::max(from, to) < middle - half_m;
  };
  if (apart(a.x, b.x, centre.x) || apart(a.y, b.y, centre.y)) return false;

  const Point2 along = b - a;
  const double reach = half_m * (std::abs(along.x) + std::abs(along.y));
  return std::abs(geometry::cross(along, centre - a)) <= reach;
}

}  // namespace

std::vector<Cell> cells_touching(const Geometry& geometry, const std::vector<Point2>& corners_in_map) {
  Point2 low = corners_in_map.front(), high = low;
  for (const Point2 corner : corners_in_map) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }

  const double half_m = 0.5 * geometry.resolution_m;
  const Cell first = geometry.cell_at(low - Point2{half_m, half_m});
  const Cell last = geometry.cell_at(high + Point2{half_m, half_m});
  std::vector<Cell> out;

  for (int y = std::max(0, first.y); y <= std::min(last.y, geometry.height - 1); ++y) {
    for (int x = std::max(0, first.x); x <= std::min(last.x, geometry.width - 1); ++x) {
      const Point2 centre = geometry.center_in_map({x, y});
      bool is_touched = geometry::is_in_polygon(corners_in_map, centre);
      for (std::size_t i = 0, j = corners_in_map.size() - 1; i < corners_in_map.size() && !is_touched; j = i++)
        is_touched = touches_square(centre, half_m, corners_in_map[j], corners_in_map[i]);
      if (is_touched) out.push_back({x, y});
    }
  }

  return out;
}

}  // namespace aisle::grid
