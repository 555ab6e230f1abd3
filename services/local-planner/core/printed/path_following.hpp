#pragma once
#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::local_planner {

/// The twist that leads along an arc to a point of the path ahead, in map. WU: while no collision is predicted the
/// vehicle "continues to follow the global path"; how is not printed, so this is pure pursuit (Coulter 1992):
///
///     curvature = 2 y / L^2      (the point at distance L lies y to the left)
///     v = min(v_max, w_max / |curvature|),  w = v curvature
///
/// A point behind the vehicle is turned to by the tightest arc of w_max at a creep.
geometry::Twist2 follow_path(const geometry::Pose2& base_in_map, geometry::Point2 ahead_in_map,
                             const kinematics::Limits& limits);

}  // namespace aisle::local_planner
