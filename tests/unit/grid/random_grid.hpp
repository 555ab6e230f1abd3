#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid::testing {

/// Odd sizes, resolutions and origins; sparse or dense; some cells unknown.
inline OccupancyGrid random_grid(std::mt19937& random, int max_edge = 40) {
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const double resolutions_m[] = {0.03, 0.05, 0.1, 0.37, 1.0, 2.0};
  Geometry geometry{
      pick(1, max_edge), pick(1, max_edge), resolutions_m[pick(0, 5)], {pick(-70, 70) * 0.13, pick(-70, 70) * 0.29}};
  OccupancyGrid grid(geometry);
  const int one_in = pick(2, 60);
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      if (pick(1, one_in) == 1) grid.set({x, y}, pick(0, 3) == 0 ? Occupancy::kUnknown : Occupancy::kOccupied);
    }
  }
  return grid;
}

/// Distance from a point to the nearest square that is not free, and to the outside; by looking at every cell.
inline double true_clearance_m(const OccupancyGrid& grid, geometry::Point2 p) {
  const Geometry& g = grid.geometry();
  const double x = (p.x - g.origin_in_map.x) / g.resolution_m;
  const double y = (p.y - g.origin_in_map.y) / g.resolution_m;
  double least = std::min({x, y, g.width - x, g.height - y});
  if (least <= 0.0) return 0.0;
  for (int cy = 0; cy < g.height; ++cy) {
    for (int cx = 0; cx < g.width; ++cx) {
      if (grid.is_free({cx, cy})) continue;
      const double dx = std::max({0.0, cx - x, x - (cx + 1)});
      const double dy = std::max({0.0, cy - y, y - (cy + 1)});
      least = std::min(least, std::hypot(dx, dy));
    }
  }
  return least * g.resolution_m;
}

inline geometry::Point2 random_point(std::mt19937& random, const Geometry& g) {
  std::uniform_real_distribution<double> x(0.0, g.width * g.resolution_m);
  std::uniform_real_distribution<double> y(0.0, g.height * g.resolution_m);
  return g.origin_in_map + geometry::Point2{x(random), y(random)};
}

}  // namespace aisle::grid::testing
