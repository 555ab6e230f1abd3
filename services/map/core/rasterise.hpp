#pragma once

#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::map {

/// Cells x_begin .. x_end-1 of row y.
struct CellRun {
  int y;
  int x_begin;
  int x_end;
};

/// The cells whose squares the shape overlaps by more than 1e-6 of a cell, clipped to the grid; each cell once. A block
/// therefore covers at least its shape, and an unblock of the same shape frees the same cells. Polygons may be concave;
/// where they cross themselves the even-odd rule holds.
/// @param edit points and radius in metres, in map
/// @param geometry of the grid: its origin in map, its resolution and its size in cells
/// @pre finite numbers; as many points as the shape needs
std::vector<CellRun> rasterise(const fleet::MapEdit& edit, const grid::Geometry& geometry);

}  // namespace aisle::map
