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

/// rad/s, of the vehicle at `speed_mps` of the fixed axle.
double turn_rate_radps(const SteeredAxle& axle, double speed_mps, double steering_rad);

/// The steering angle of this motion, within the axle's limit; `otherwise_rad` when the vehicle stands, for then any
/// will do.
double steering_for_rad(const SteeredAxle& axle, const geometry::Twist2& twist, double otherwise_rad);

/// Of the tightest circle of the fixed axle's middle, in metres.
double least_radius_m(const SteeredAxle& axle);

struct TricycleState {
  double speed_mps{0.0};
  double steering_rad{0.0};
};

/// Turns the wheel towards what `wanted` asks for and speeds up or slows down towards its speed, each within its
/// limits, for `dt_s`. A turn that the vehicle cannot drive becomes the nearest that it can; one on the spot becomes a
/// stand. Where the wheel is turned so far that it would turn faster than max_turn_radps, it drives slower, as drive
/// controllers of forklifts do.
TricycleState limit_change_tricycle(const TricycleState& current, const geometry::Twist2& wanted, const Limits& limits,
                                    double dt_s);

}  // namespace aisle::kinematics
