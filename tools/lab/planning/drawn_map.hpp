#pragma once

#include <filesystem>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {

/// A map drawn as text with its start and goal.
struct DrawnMap {
  grid::OccupancyGrid grid;
  geometry::Point2 start_in_map;
  geometry::Point2 goal_in_map;
};

/// '#' occupied, '.' free, one 'S' and one 'T' for start and goal (free); the first line is the top row. Lower left
/// corner at (0, 0).
/// @throws config::BadInput with file and line
DrawnMap read_drawn_map(const std::filesystem::path& file, double cell_m);

}  // namespace aisle::lab
