#pragma once

#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "tools/draw/map_frame.hpp"

namespace aisle::draw {

/// An axis-parallel rectangle of the map.
struct Box {
  geometry::Point2 low_in_map;
  geometry::Point2 high_in_map;
};

/// The boxes of a grid that have the same occupancy, row by row from below.
struct GridLayers {
  std::vector<Box> occupied;
  std::vector<Box> unknown;
};

/// Runs of equal blocks of `edge` x `edge` cells, each as one box. A block is occupied when one of its
/// cells is, else unknown when one of its cells is. With edge 1 the boxes are exactly the grid.
GridLayers grid_layers(const grid::OccupancyGrid& grid, int edge = 1);

/// Everything that is not free, in few boxes.
///
/// How: from the top row down, each run of cells that are not free grows downwards as long as the cells
/// below it are like it.
std::vector<Box> obstacles(const grid::OccupancyGrid& grid);

/// How exactly corners are written.
enum class Digits {
  kTenth,  // of a pixel, as everything else
  kFine,   // five digits: boxes that adjoin leave no seam where a row is no whole number of pixels
};

/// The `d` of a path around all the boxes.
std::string boxes_path(const MapFrame& frame, const std::vector<Box>& boxes, Digits digits);

}  // namespace aisle::draw
