#pragma once
#include "common/grid/clearance.hpp"

namespace aisle::grid {

/// True when a disc of `radius_m` may sweep the straight segment from `from` to `to`: every cell that the segment touches
/// (supercover, corners included) is traversable for it. Steps by the clearance where there is plenty.
bool is_line_free(const ClearanceField& clearance, geometry::Point2 from_in_map, geometry::Point2 to_in_map, double radius_m);

/// First point of the ray from `from` in direction `angle_rad` that lies on a cell that is not free, as a distance in metres;
/// `max_range_m` when there is none. Exact grid traversal (Amanatides, Woo 1987). Outside the grid is empty space.
double cast_ray(const OccupancyGrid& grid, geometry::Point2 from_in_map, double angle_rad, double max_range_m);

}  // namespace aisle::grid
