#pragma once

#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {

/// A planner's path.
struct DrawnPath {
  std::string name;
  std::vector<geometry::Point2> in_map;
};

/// The map and the paths over it, one colour each, with a legend; as an SVG file's text. Large maps are drawn coarser.
std::string plan_svg(const grid::OccupancyGrid& grid, const std::vector<DrawnPath>& paths);

}  // namespace aisle::lab
