#pragma once
#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

struct MapFileOptions {
  double moving_ai_cell_m{1.0};   // edge of a Moving AI or text cell
  int subdivide{1};               // each file cell becomes subdivide x subdivide cells of the grid
};

/// Reads a map by its ending: ROS map_server `.yaml` (with PGM or PNG; trinary, scale, raw; negate; origin with a yaw is refused),
/// Moving AI `.map` (row 0 on top), or a plain text grid `.txt` ('#' occupied, '.' free, '?' unknown; first line on top).
/// At most 16384 tiles of 64 x 64 cells. @throws config::BadInput with file, line or key, value, limit and what to do.
OccupancyGrid read_map_file(const std::filesystem::path& file, const MapFileOptions& options = {});

/// Writes `<stem>.yaml` and `<stem>.pgm` (trinary): to a temporary name first, then renamed. @throws std::system_error
void write_ros_map(const OccupancyGrid& grid, const std::filesystem::path& yaml_file);

}  // namespace aisle::grid
