#pragma once
#include <vector>

#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

/// Makes a drivable path shorter or straighter in place; it stays drivable, its first and last points stay as they are.
using Pass = void (*)(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

namespace passes {

/// P1: drops a point that lies on the straight line between its neighbours and between them (LI, WU, QU, YU, WANG step
/// 1).
void collinear(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P1a: as P1, but of each straight run one point more stays, the first with an obstacle among the eight cells around
/// it: LI (IV.B.2a) goes on from N3 to N8, "the node with obstacles" of N4 to N8.
void collinear_but_one_beside_obstacles(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P2: drops the corner of a right angle between two neighbouring cells that the vehicle can drive between directly
/// (LI).
void right_angle(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P3: from each kept point on to the farthest point before the first that it cannot be joined to (WANG step 2, QU,
/// YU).
void greedy_line_of_sight(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P4: P3 with lines that keep the problem's safe distance everywhere, again and again until nothing changes (QU,
/// 2.3.2). A path that comes nearer itself keeps its points there.
void safe_distance(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P5: moves the start of each segment along it, to the farthest sample (one a cell, at most 64) that the point kept
/// before can be joined to (WU step 2).
void interpolated_forward(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P5 with the safe distance: moves the start of each segment along it, sample by sample for as long as the line from
/// the point kept before keeps the problem's safe distance, and stops at the first that does not (YU third, 2.3 (3)).
void interpolated_at_safe_distance(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

/// P6: P5 from the goal to the start (WU step 3).
void interpolated_backward(const Drivable& drivable, std::vector<geometry::Point2>& path_in_map);

}  // namespace passes
}  // namespace aisle::global_planner
