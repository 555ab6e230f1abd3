#pragma once

#include "common/geometry/pose.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::kinematics {

/// A fixed axle and one steered wheel, `wheelbase_m` before or behind it (forklifts, tow tractors). The vehicle's frame
/// lies in the middle of the fixed axle, x ahead. With the steering angle delta, counter-clockwise from straight:
///
///     w = v tan(delta) / wheelbase      (steered wheel ahead; behind: the other sign)
///
/// (Siciliano and others, Robotics, 2009, section 11.2.2). So it cannot turn on the spot, and each steering angle is an
/// arc.

/// Turn rate of the vehicle in rad/s, counter-clockwise, at `speed_mps` of the fixed axle (the equation
/// above).
double turn_rate_radps(const SteeredAxle& axle, double speed_mps, double steering_rad);

/// The steering angle in radians of this motion, within the axle's limit; `otherwise_rad` when the
/// vehicle stands: then every angle gives that motion.
double steering_for_rad(const SteeredAxle& axle, const geometry::Twist2& twist, double otherwise_rad);

/// Radius in metres of the tightest circle that the middle of the fixed axle can drive.
double least_radius_m(const SteeredAxle& axle);

/// Speed of the fixed axle (negative: backwards) and angle of the steered wheel, counter-clockwise from
/// straight.
struct TricycleState {
  double speed_mps{0.0};
  double steering_rad{0.0};
};

/// Turns the wheel towards the angle of `wanted` and changes the speed towards that of `wanted`, each
/// within its limits, for `dt_s` seconds.
///
/// A turn that is too tight becomes the tightest that the axle can steer; a turn on the spot becomes a
/// stand. Where the wheel stands so far to the side that the vehicle would turn faster than
/// max_turn_radps, it drives slower, as drive controllers of forklifts do.
TricycleState limit_change_tricycle(const TricycleState& current, const geometry::Twist2& wanted, const Limits& limits,
                                    double dt_s);

}  // namespace aisle::kinematics
