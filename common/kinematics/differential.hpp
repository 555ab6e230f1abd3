#pragma once

#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::kinematics {

/// Two driven wheels on one axle, in whose middle the vehicle's frame lies: speed and turn rate are
/// independent of each other, the vehicle can turn on the spot, and it never moves sideways (Siciliano
/// and others, Robotics, 2009, section 11.2.1: the unicycle).
///
/// @returns the twist nearest to `wanted` that can be reached from `current` within `dt_s` seconds.
/// Speeding up uses the acceleration limit, slowing down the deceleration limit.
geometry::Twist2 limit_change_differential(const geometry::Twist2& current, const geometry::Twist2& wanted,
                                           const Limits& limits, double dt_s);

}  // namespace aisle::kinematics
