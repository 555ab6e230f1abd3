#pragma once

#include "tools/lab/planning/subject.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::lab {

/// A drive over a researcher's own map: one round vehicle, "agv-1", from the start of a query to its goal, by our own
/// drive. The caller names the planners. The run ends at the goal, or when the way around the map could have been
/// driven twice. `name` stands for the map in reports.
/// @throws config::BadInput when start or goal lies outside the map, or the vehicle's disc in a wall
sim::Setup map_setup(const std::string& name, const Subject& subject, const Query& query, double radius_m);

/// @throws config::BadInput, beginning with `name`, as map_setup
void check_ends(const std::string& name, const grid::OccupancyGrid& grid, const Query& query, double radius_m);

}  // namespace aisle::lab
