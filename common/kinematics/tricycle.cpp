#include "common/kinematics/tricycle.hpp"

#include <algorithm>
#include <cmath>

#include "common/kinematics/axis.hpp"

namespace aisle::kinematics {
namespace {

/// Slower than this counts as a stand: the steering angle cannot be told from the motion.
constexpr double kStandingMps = 1e-3;

}  // namespace

double turn_rate_radps(const SteeredAxle& axle, double speed_mps, double steering_rad) {
  const double rate = speed_mps * std::tan(steering_rad) / axle.wheelbase_m;
  return axle.is_rear ? -rate : rate;
}

/// delta = atan(wheelbase w / v), the equation of the header turned round.
double steering_for_rad(const SteeredAxle& axle, const geometry::Twist2& twist, double otherwise_rad) {
  if (std::abs(twist.linear_mps) < kStandingMps) return otherwise_rad;
  const double steering = std::atan(axle.wheelbase_m * twist.angular_radps / twist.linear_mps);
  return std::clamp(axle.is_rear ? -steering : steering, -axle.max_steering_rad, axle.max_steering_rad);
}

double least_radius_m(const SteeredAxle& axle) { return axle.wheelbase_m / std::tan(axle.max_steering_rad); }

/// First the wheel, then the speed: the wheel's new angle says how fast the vehicle may go, v <=
/// max_turn wheelbase / |tan(delta)|.
TricycleState limit_change_tricycle(const TricycleState& current, const geometry::Twist2& wanted, const Limits& limits,
                                    double dt_s) {
  const SteeredAxle& axle = limits.axle;
  const double target_rad = steering_for_rad(axle, wanted, current.steering_rad);
  const double turn = axle.max_steering_rate_radps * dt_s;
  const double steering = current.steering_rad + std::clamp(target_rad - current.steering_rad, -turn, turn);
  const double per_metre = std::abs(turn_rate_radps(axle, 1.0, steering));
  const double fastest = per_metre > 1e-9 ? limits.max_turn_radps / per_metre : 1e9;
  const double speed = std::clamp(wanted.linear_mps, -std::min(limits.max_reverse_mps, fastest),
                                  std::min(limits.max_speed_mps, fastest));

  return {approach(current.speed_mps, speed, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s),
          steering};
}

}  // namespace aisle::kinematics
