#include "tools/sim/scenarios/gap_to_walls.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/separation.hpp"

namespace aisle::sim {

using geometry::Point2;

/// Looks at every square within reach: for a disc the distance from its middle to the square less its
/// radius, for a rectangle the separation of two rectangles.
double gap_to_walls_m(const grid::OccupancyGrid& walls, const geometry::Body& body, double look_m) {
  const grid::Geometry& g = walls.geometry();
  const Point2 p = body.base_in_map.position();
  const grid::Cell c = g.cell_at(p);
  const bool is_disc = body.shape == geometry::Body::Shape::kDisc;
  const int reach = static_cast<int>(std::ceil((look_m + geometry::reach_m(body)) / g.resolution_m));
  double least = look_m + (is_disc ? body.radius_m : 0.0);

  for (int y = c.y - reach; y <= c.y + reach; ++y)
    for (int x = c.x - reach; x <= c.x + reach; ++x) {
      if (walls.is_free({x, y})) continue;

      const Point2 center = g.center_in_map({x, y});
      if (!is_disc) {
        least = std::min(
            least,
            geometry::separation_m(
                body,
                {geometry::Body::Shape::kRectangle, {center.x, center.y, 0.0}, 0.0, g.resolution_m, g.resolution_m}));
        continue;
      }

      const Point2 d = p - center;
      const double half = 0.5 * g.resolution_m;

      least = std::min(least, std::hypot(std::max(0.0, std::abs(d.x) - half), std::max(0.0, std::abs(d.y) - half)));
    }

  return is_disc ? least - body.radius_m : least;
}

}  // namespace aisle::sim
