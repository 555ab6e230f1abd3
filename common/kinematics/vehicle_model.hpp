#pragma once
#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::kinematics {

/// Pose after driving with a constant twist for `dt_s` (exact arc, not an Euler step), whatever the model.
geometry::Pose2 advance(const geometry::Pose2& base_in_map, const geometry::Twist2& twist, double dt_s);

/// How a vehicle moves, and where its steered wheel points, which a twist does not say of a vehicle that stands.
struct DriveState {
  geometry::Twist2 twist;
  double steering_rad{0.0};  // of a tricycle, else 0
};

/// The motion nearest to `wanted` that the model and its limits let a vehicle reach from `current` within `dt_s`.
DriveState follow(const DriveState& current, const geometry::Twist2& wanted, const Limits& limits, double dt_s);

/// The same where only the twist is known: a tricycle that stands is taken to be steered straight.
geometry::Twist2 limit_change(const geometry::Twist2& current, const geometry::Twist2& wanted, const Limits& limits,
                              double dt_s);

/// Radius of the tightest arc that can be driven; 0: it turns on the spot.
double least_turning_radius_m(const Limits& limits);

/// Metres to a stand from this speed.
double stopping_distance_m(double speed_mps, double deceleration_mps2);

}  // namespace aisle::kinematics
