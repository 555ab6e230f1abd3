#pragma once

#include <optional>

#include "common/geometry/footprint.hpp"
#include "common/grid/clearance.hpp"

namespace aisle::global_planner {

/// What a moving vehicle touches, square by square. Only which squares of the field are not free counts, none of its
/// distances; so this shares nothing with the searches, nor with how they look at lines, and can judge both. Outside
/// the grid nothing is free.

/// A square nearer than `radius_m` to the straight segment (by more than 10 um, for rounding), or touched by it; none
/// when the disc may sweep it. @pre finite numbers
std::optional<grid::Cell> square_near_line(const grid::ClearanceField& field, geometry::Point2 from_in_map,
                                           geometry::Point2 to_in_map, double radius_m);

/// What the outline overlapped, and at which pose of the vehicle.
struct Touch {
  grid::Cell square;
  geometry::Pose2 base_in_map;  // where the outline lies on it; within the straight way, its end
};

/// A square that a rectangle overlaps by more than 10 um between two poses; none when it passes. Place and heading
/// change evenly from one pose to the other, the heading the shorter way round. Exact where the vehicle drives straight
/// ahead or back (the rectangle drawn out along the way); where it turns as well, by conservative advancement: the way
/// is halved until no square is as near as the outline can move (Mirtich 1996).
/// @pre finite numbers; the footprint is no disc
std::optional<Touch> touched_on_way(const grid::ClearanceField& field, const geometry::Footprint& footprint,
                                    const geometry::Pose2& from_in_map, const geometry::Pose2& to_in_map);

}  // namespace aisle::global_planner
