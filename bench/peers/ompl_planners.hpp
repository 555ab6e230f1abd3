#pragma once

#include <string>

#include "bench/peers/peer.hpp"
#include "common/grid/clearance.hpp"

namespace aisle::bench {

/// OMPL's sampling planners for a point in the plane: "RRTConnect" and "BITstar", stopped at their first solution or
/// after `limit_s`. Lengths are any-angle, so below the octile optimum is possible. `expanded` stays 0.
/// @throws std::invalid_argument for another name
PeerAnswer ompl_plan(const std::string& planner, const grid::ClearanceField& clearance, geometry::Point2 start_in_map,
                     geometry::Point2 goal_in_map, double limit_s);

}  // namespace aisle::bench
