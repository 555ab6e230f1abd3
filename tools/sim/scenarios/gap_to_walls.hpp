#pragma once

#include "common/geometry/body.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::sim {

/// From an outline to the nearest square of the map that is not free, at most `look_m`; 0: they touch. Exact.
double gap_to_walls_m(const grid::OccupancyGrid& walls, const geometry::Body& body, double look_m);

}  // namespace aisle::sim
