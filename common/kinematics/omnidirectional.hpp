#pragma once

#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::kinematics {

/// Mecanum or swerve wheels: ahead, sideways and turning are independent of each other (LI eq. 4, YU
/// eq. 7, WANG eq. 6).
///
/// All three papers print the second line of the rotation wrongly: LI and YU end it with - v_y dt cos(theta),
/// WANG has v_y dt sin(theta) + v_x dt cos(theta). Repaired:
///
///     y += v_x dt sin(theta) + v_y dt cos(theta)
///
/// The speed is the length of the velocity in the vehicle's frame: at most max_speed_mps in every
/// direction, at most max_reverse_mps backwards. Within `dt_s` seconds it changes by at most the
/// acceleration limit times `dt_s`; where it becomes less, by the deceleration limit times `dt_s`.
geometry::Twist2 limit_change_omnidirectional(const geometry::Twist2& current, const geometry::Twist2& wanted,
                                              const Limits& limits, double dt_s);

}  // namespace aisle::kinematics
