#include "services/fake-vehicle/core/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/separation.hpp"

namespace aisle::fake_vehicle {
namespace {

/// From the point to the square of the cell; 0 inside of it.
double distance_to_cell_m(const grid::Geometry& g, grid::Cell cell, geometry::Point2 in_map) {
  const geometry::Point2 center = g.center_in_map(cell);
  const double half = 0.5 * g.resolution_m;
  return std::hypot(std::max(0.0, std::abs(in_map.x - center.x) - half),
                    std::max(0.0, std::abs(in_map.y - center.y) - half));
}

/// Over the cells of the square that the disc, grown by `look_m`, lies in; then over all bodies.
double gap_of_disc_m(const Surroundings& around, geometry::Point2 center_in_map, double radius_m, double look_m) {
  const double reach = radius_m + look_m;
  const grid::Geometry& g = around.walls.geometry();

  const grid::Cell low = g.cell_at({center_in_map.x - reach, center_in_map.y - reach});
  const grid::Cell high = g.cell_at({center_in_map.x + reach, center_in_map.y + reach});

  double nearest = reach;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (!around.walls.is_free({x, y})) nearest = std::min(nearest, distance_to_cell_m(g, {x, y}, center_in_map));
    }
  }

  for (const geometry::Body& body : around.bodies)
    nearest = std::min(nearest, geometry::distance_m(body, center_in_map));

  return nearest - radius_m;
}

/// The same for a rectangle, with the distance between two rectangles in place of that to a point.
double gap_of_rectangle_m(const Surroundings& around, const geometry::Body& self, double look_m) {
  const double reach = geometry::reach_m(self) + look_m;
  const geometry::Point2 center = self.base_in_map.position();
  const grid::Geometry& g = around.walls.geometry();

  const grid::Cell low = g.cell_at({center.x - reach, center.y - reach});
  const grid::Cell high = g.cell_at({center.x + reach, center.y + reach});

  double nearest = look_m;
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (around.walls.is_free({x, y})) continue;

      const geometry::Point2 c = g.center_in_map({x, y});
      nearest = std::min(
          nearest,
          geometry::separation_m(
              self, {geometry::Body::Shape::kRectangle, {c.x, c.y, 0.0}, 0.0, g.resolution_m, g.resolution_m}));
    }
  }

  for (const geometry::Body& body : around.bodies) nearest = std::min(nearest, geometry::separation_m(self, body));

  return nearest;
}

}  // namespace

double gap_m(const Surroundings& around, const geometry::Body& self, double look_m) {
  if (self.shape == geometry::Body::Shape::kRectangle) return gap_of_rectangle_m(around, self, look_m);
  return gap_of_disc_m(around, self.base_in_map.position(), self.radius_m, look_m);
}

}  // namespace aisle::fake_vehicle
