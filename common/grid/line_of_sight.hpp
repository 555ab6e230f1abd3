#pragma once
#include "common/grid/clearance.hpp"

namespace aisle::grid {

/// True only when a disc of `radius_m` may sweep the straight segment from `from` to `to`: nowhere on it is the nearest square that
/// is not free closer than the radius (to 1e-6 of a cell), and no such square is touched, not even at a corner.
/// Safe, and nearly tight: it may say no to a line that passes within 0.115 of a cell too close. It never says no between
/// neighbours in a row or column that are both traversable, nor between diagonal neighbours when the two beside them are as well.
/// Visits every square between four centres that the segment touches (supercover), and steps by the clearance where there is plenty.
bool is_line_free(const ClearanceField& clearance, geometry::Point2 from_in_map, geometry::Point2 to_in_map, double radius_m);

/// First point of the ray from `from` in direction `angle_rad` that lies on a cell that is not free, as a distance in metres;
/// `max_range_m` when there is none. Exact grid traversal (Amanatides, Woo 1987). Outside the grid is empty space.
/// @pre finite numbers
double cast_ray(const OccupancyGrid& grid, geometry::Point2 from_in_map, double angle_rad, double max_range_m);

}  // namespace aisle::grid
