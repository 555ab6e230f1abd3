#pragma once

#include <vector>

#include "common/geometry/body.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::fake_vehicle {

/// The true world around a vehicle: walls, and the bodies of all other things that move or stand on the floor.
struct Surroundings {
  const grid::OccupancyGrid& walls;
  const std::vector<geometry::Body>& bodies;
};

/// Free distance in metres around a body: to the nearest wall (a cell that is not free, or the map's border) or body.
/// Negative when it overlaps one, by so much. Looks no farther than `look_m` beyond the body, and then returns
/// `look_m`.
double gap_m(const Surroundings& around, const geometry::Body& self, double look_m);

}  // namespace aisle::fake_vehicle
