#pragma once

#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {

/// A drive past one mover, or past boxes, as a picture shows it. Ways have a point each tenth of a second, from the
/// start on.
struct WindowScene {
  std::string title;
  geometry::Point2 start_in_map, goal_in_map;  // the path is the line between
  double vehicle_radius_m{0.35};
  std::vector<geometry::Point2> driven_in_map;
  double mover_radius_m{0.25};
  std::vector<geometry::Point2> mover_in_map;  // empty: there is none

  struct Aimed {
    geometry::Point2 from_in_map, at_in_map;
  };

  std::vector<Aimed> sub_targets;  // where it aimed instead of along the path; moments without one are left out

  struct Box {
    geometry::Point2 low_in_map, high_in_map;
  };

  std::vector<Box> boxes;
};

/// The picture of the scene: vehicle and mover with their outlines and the time, every two seconds
/// while they move; local sub-targets, each with the place from which it was aimed at; the place where
/// the two came nearest; a scale in metres. @returns an SVG file's text
std::string window_svg(const grid::OccupancyGrid& grid, const WindowScene& scene);

}  // namespace aisle::lab
