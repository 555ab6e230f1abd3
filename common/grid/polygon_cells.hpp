#pragma once

#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

/// All cells of the grid whose squares touch the polygon, row by row from the bottom. Its edge belongs to it; where it
/// crosses itself the even-odd rule holds.
/// @pre at least three corners
std::vector<Cell> cells_touching(const Geometry& geometry, const std::vector<geometry::Point2>& corners_in_map);

}  // namespace aisle::grid
