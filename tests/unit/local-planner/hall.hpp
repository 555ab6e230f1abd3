#pragma once
// Halls and aisles for the tests of this folder.
#include "common/grid/clearance.hpp"

namespace aisle::local_planner {

/// Walls all around, `resolution` 0.05 m; `block` fills rectangles.
inline grid::OccupancyGrid hall(double width_m, double height_m) {
  const grid::Geometry geometry{
      static_cast<int>(std::lround(width_m / 0.05)), static_cast<int>(std::lround(height_m / 0.05)), 0.05, {0.0, 0.0}};
  grid::OccupancyGrid grid(geometry);
  for (int y = 0; y < geometry.height; ++y)
    for (int x = 0; x < geometry.width; ++x)
      if (x == 0 || y == 0 || x == geometry.width - 1 || y == geometry.height - 1)
        grid.set({x, y}, grid::Occupancy::kOccupied);
  return grid;
}

inline void block(grid::OccupancyGrid& grid, double x0, double y0, double x1, double y1) {
  const auto& geometry = grid.geometry();
  for (int y = 0; y < geometry.height; ++y)
    for (int x = 0; x < geometry.width; ++x) {
      const geometry::Point2 c = geometry.center_in_map({x, y});
      if (c.x > x0 && c.x < x1 && c.y > y0 && c.y < y1) grid.set({x, y}, grid::Occupancy::kOccupied);
    }
}

/// An aisle along x between x = 0 and 20, around y = 5, of this width.
inline grid::OccupancyGrid aisle(double width_m) {
  grid::OccupancyGrid grid = hall(20.0, 10.0);
  block(grid, 0.0, 0.0, 20.0, 5.0 - 0.5 * width_m);
  block(grid, 0.0, 5.0 + 0.5 * width_m, 20.0, 10.0);
  return grid;
}

}  // namespace aisle::local_planner
