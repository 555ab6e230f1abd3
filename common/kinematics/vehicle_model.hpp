#pragma once

#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::kinematics {

/// Pose after driving with a constant twist for `dt_s` seconds, in map, for every model.
///
/// Exact arc, not an Euler step: with w = yaw rate, a = w dt, and velocity (u, v) in the vehicle's
/// frame, the way in the frame of the start is
///
///     dx = (u sin(a) - v (1 - cos(a))) / w
///     dy = (u (1 - cos(a)) + v sin(a)) / w
geometry::Pose2 advance(const geometry::Pose2& base_in_map, const geometry::Twist2& twist, double dt_s);

/// How a vehicle moves, and where its steered wheel points: the twist of a vehicle that stands does not
/// tell.
struct DriveState {
  geometry::Twist2 twist;
  double steering_rad{0.0};  // of a tricycle, else 0
};

/// The motion nearest to `wanted` that the vehicle can reach from `current` within `dt_s` seconds, by
/// its model and its limits.
DriveState follow(const DriveState& current, const geometry::Twist2& wanted, const Limits& limits, double dt_s);

/// The same where only the twist is known: a tricycle that stands is taken to be steered straight.
geometry::Twist2 limit_change(const geometry::Twist2& current, const geometry::Twist2& wanted, const Limits& limits,
                              double dt_s);

/// Radius in metres of the tightest arc that can be driven; 0 for models that turn on the spot.
double least_turning_radius_m(const Limits& limits);

/// Metres to a stand from this speed with a constant deceleration: v^2 / 2a.
double stopping_distance_m(double speed_mps, double deceleration_mps2);

}  // namespace aisle::kinematics
