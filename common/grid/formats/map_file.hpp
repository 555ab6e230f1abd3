#pragma once
#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

struct MapFileOptions {
  double moving_ai_cell_m{1.0};  // edge of a Moving AI or text cell
  int subdivide{1};              // each file cell becomes subdivide x subdivide cells of the grid; at most 64
};

/// Reads a map by its ending: ROS map_server `.yaml` (with a PGM or PNG beside it; trinary, scale, raw; negate; an
/// origin with a yaw is refused), Moving AI `.map` (row 0 on top; `.GS` free, `@OTW` blocked), or a plain text grid
/// `.txt` ('#' occupied,
/// '.' free, '?' unknown; first line on top). Text may have CRLF line ends and a byte order mark.
/// At most 16384 tiles of 64 x 64 cells, looked at before anything of that size is allocated.
/// In scale and raw mode, what is neither surely free nor surely occupied is unknown, as it is in trinary mode.
/// Transparent pixels are unknown.
/// @throws config::BadInput with file, line or key, value, limit and what to do.
OccupancyGrid read_map_file(const std::filesystem::path& file, const MapFileOptions& options = {});

/// Writes `<stem>.yaml` and the image it names, `<stem>-<hash of the cells>.pgm` (trinary). The yaml is renamed into
/// place when everything is on disk: whoever reads, or pulls the plug, finds the old map or the new one, never a
/// mixture. The image of the map written before is removed. @throws std::system_error
void write_ros_map(const OccupancyGrid& grid, const std::filesystem::path& yaml_file);

}  // namespace aisle::grid
