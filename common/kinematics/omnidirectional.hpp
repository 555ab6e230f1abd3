#pragma once

#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::kinematics {

/// Mecanum or swerve wheels: ahead, sideways and turning are independent of each other (LI eq. 4, YU
/// eq. 7 with the sign of its v_y sin term as a rotation needs it; docs/experiments.md).
///
/// The speed is the length of the velocity in the vehicle's frame: at most max_speed_mps in every
/// direction, at most max_reverse_mps backwards. Within `dt_s` seconds it changes by at most the
/// acceleration limit times `dt_s`; where it becomes less, by the deceleration limit times `dt_s`.
geometry::Twist2 limit_change_omnidirectional(const geometry::Twist2& current, const geometry::Twist2& wanted,
                                              const Limits& limits, double dt_s);

}  // namespace aisle::kinematics
