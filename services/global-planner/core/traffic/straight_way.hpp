#pragma once

#include "common/grid/clearance.hpp"

namespace aisle::global_planner::traffic {

/// May a disc of `need_m` drive straight from one point to the other? An end that lies nearer to a wall is an
/// exception: within `need_m` of it the way may be as near to a wall as that end is.
bool is_straight_way_free(const grid::ClearanceField& clearance, geometry::Point2 from_in_map,
                          geometry::Point2 to_in_map, double need_m);

}  // namespace aisle::global_planner::traffic
