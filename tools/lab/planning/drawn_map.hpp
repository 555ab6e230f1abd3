#pragma once

#include <filesystem>
#include <optional>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {

/// A map drawn as text with its start and goal.
struct DrawnMap {
  grid::OccupancyGrid grid;
  geometry::Point2 start_in_map;
  geometry::Point2 goal_in_map;
};

/// '#' occupied, '.' free, one 'S' and one 'T' for start and goal (free); the first line is the top row. Lower left
/// corner at (0, 0). Line ends may be CRLF.
/// @throws config::BadInput with file and line, also when S or T is missing
DrawnMap read_drawn_map(const std::filesystem::path& file, double cell_m);

/// A map to experiment on; start and goal where the file has them.
struct LabMap {
  grid::OccupancyGrid grid;
  std::optional<geometry::Point2> start_in_map{};
  std::optional<geometry::Point2> goal_in_map{};
};

/// Reads any map that a researcher may have, by its ending: a picture (`.png`, `.pgm`), a ROS map (`.yaml`), a map of
/// Moving AI (`.map`) or text (`.txt`, as read_drawn_map, but '?' is unknown, and S and T may be missing).
///
/// `cell_m`: edge of a cell, 0 where it was not said. A picture needs it, text and Moving AI have cells of 1 m without
/// it, and a ROS map, which says it itself, refuses it.
/// @throws config::BadInput with file, place, limit and what to do
LabMap read_lab_map(const std::filesystem::path& file, double cell_m = 0.0);

}  // namespace aisle::lab
