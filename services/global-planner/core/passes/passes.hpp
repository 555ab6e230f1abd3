#pragma once
#include <vector>

#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

/// Makes a drivable path shorter or straighter in place; it stays drivable, its first and last points stay as they are.
using Pass = void (*)(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

namespace passes {

/// P1: drops a point that lies on the straight line between its neighbours and between them (LI, WU, QU, YU, WANG step 1).
void collinear(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P3: from each kept point on to the farthest point before the first that it cannot be joined to (WANG step 2, QU, YU).
void greedy_line_of_sight(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

}  // namespace passes
}  // namespace aisle::global_planner
