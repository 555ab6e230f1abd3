#pragma once

#include <filesystem>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

/// Is it a picture by its ending, `.png` or `.pgm`?
bool is_picture(const std::filesystem::path& file);

/// Reads a picture (PNG or PGM) as a map: one cell a pixel, row 0 on top, lower left corner at (0, 0) in map. Dark
/// pixels (at least 65 % black) are occupied, light ones (less than 19.6 % black) free, as ROS map_server's defaults
/// have it; what lies between, or is transparent, is unknown, and no planner drives there.
///
/// `cell_m`: edge of a pixel in metres, from 0.001 to 1000; 0 says that it is not known, which is refused.
/// @throws config::BadInput with file, limit and what to do
OccupancyGrid read_picture_map(const std::filesystem::path& file, double cell_m);

}  // namespace aisle::grid
