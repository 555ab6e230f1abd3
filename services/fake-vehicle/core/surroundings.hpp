#pragma once
#include <vector>

#include "common/geometry/body.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::fake_vehicle {

/// The true world around a vehicle: walls, and all that moves or stands on the floor but the vehicle itself.
struct Surroundings {
  const grid::OccupancyGrid& walls;
  const std::vector<geometry::Body>& bodies;
};

/// Free distance around a body: to the nearest wall (a cell that is not free, or the map's border) or body.
/// Negative: it overlaps by so much. Looks no farther than `look_m` beyond it, and then returns `look_m`.
double gap_m(const Surroundings& around, const geometry::Body& self, double look_m);

}  // namespace aisle::fake_vehicle
