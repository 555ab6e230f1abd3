#pragma once

#include <filesystem>
#include <string>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

/// What a file does not say itself.
struct MapFileOptions {
  double moving_ai_cell_m{1.0};  // edge of a Moving AI or text cell
  int subdivide{1};              // each file cell becomes subdivide x subdivide cells of the grid; at most 64
};

/// Reads a map in the format that the file's ending says:
///
///   - `.yaml`: ROS map_server, with a PGM or PNG beside it; modes trinary, scale and raw; negate. An origin with a yaw
///   is refused.
///   - `.map`: Moving AI; row 0 on top; `.GS` free, `@OTW` blocked.
///   - `.txt`: plain text grid; first line on top; '#' occupied, '.' free, '?' unknown. Line ends may be CRLF, a byte
///   order mark is skipped.
///
/// In scale and raw mode, a cell that is neither surely free nor surely occupied is unknown, as it is
/// in trinary mode. Transparent pixels are unknown.
///
/// A map has at most 16384 tiles of 64 x 64 cells; this is checked before anything of that size is
/// allocated. @throws config::BadInput with file, line or key, value, limit and what to do.
OccupancyGrid read_map_file(const std::filesystem::path& file, const MapFileOptions& options = {});

/// Writes `<stem>.yaml` and the image that it names, `<stem>-<hash of the cells>.pgm` (trinary), as ROS
/// map_server reads them.
///
/// The yaml is renamed into place when everything is on disk: a reader, even after a power cut, finds
/// the old map or the new one, never a mixture. The image of the map written before is removed. @throws
/// std::system_error
void write_ros_map(const OccupancyGrid& grid, const std::filesystem::path& yaml_file);

}  // namespace aisle::grid
