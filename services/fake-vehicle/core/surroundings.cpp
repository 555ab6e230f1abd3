#include "services/fake-vehicle/core/surroundings.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::fake_vehicle {
namespace {

/// From the point to the square of the cell.
double distance_to_cell_m(const grid::Geometry& g, grid::Cell cell, geometry::Point2 in_map) {
  const geometry::Point2 center = g.center_in_map(cell);
  const double half = 0.5 * g.resolution_m;
  return std::hypot(std::max(0.0, std::abs(in_map.x - center.x) - half), std::max(0.0, std::abs(in_map.y - center.y) - half));
}

}  // namespace

double gap_m(const Surroundings& around, geometry::Point2 center_in_map, double radius_m, double look_m) {
  const double reach = radius_m + look_m;
  double nearest = reach;
  const grid::Geometry& g = around.walls.geometry();
  const grid::Cell low = g.cell_at({center_in_map.x - reach, center_in_map.y - reach});
  const grid::Cell high = g.cell_at({center_in_map.x + reach, center_in_map.y + reach});
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!around.walls.is_free({x, y})) nearest = std::min(nearest, distance_to_cell_m(g, {x, y}, center_in_map));
    }
  }
  for (const geometry::Body& body : around.bodies) nearest = std::min(nearest, geometry::distance_m(body, center_in_map));
  return nearest - radius_m;
}

}  // namespace aisle::fake_vehicle
