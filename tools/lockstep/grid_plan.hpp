#pragma once
#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::lockstep {

/// Shortest way on the grid for a disc of `radius_m`, straightened; empty: none.
std::vector<geometry::Point2> grid_plan(const grid::ClearanceField& clearance, geometry::Point2 start, geometry::Point2 goal, double radius_m);

}  // namespace aisle::lockstep
