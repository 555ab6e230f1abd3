#include "common/kinematics/vehicle_model.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::kinematics {
namespace {

/// One axis: from `current` towards `wanted`, within `dt_s`. Away from zero at `speed_up`, towards zero at `slow_down`;
/// through zero, the time that is left after the stand is spent at `speed_up`.
double approach(double current, double wanted, double speed_up, double slow_down, double dt_s) {
  const bool through_zero = current * wanted < 0.0;
  if (through_zero) {
    const double stop_s = std::abs(current) / slow_down;
    if (stop_s >= dt_s) return current - std::copysign(slow_down * dt_s, current);
    return std::copysign(std::min(std::abs(wanted), speed_up * (dt_s - stop_s)), wanted);
  }
  const double rate = std::abs(wanted) < std::abs(current) ? slow_down : speed_up;
  return current + std::clamp(wanted - current, -rate * dt_s, rate * dt_s);
}

}  // namespace

geometry::Pose2 advance(const geometry::Pose2& base_in_map, const geometry::Twist2& twist, double dt_s) {
  const double turn_rad = twist.angular_radps * dt_s;
  // Chord of the arc in the frame of the pose: sin(a)/a and (1-cos(a))/a, by their series near 0.
  const bool straight = std::abs(turn_rad) < 1e-6;
  const double along = straight ? 1.0 - turn_rad * turn_rad / 6.0 : std::sin(turn_rad) / turn_rad;
  const double across = straight ? 0.5 * turn_rad : (1.0 - std::cos(turn_rad)) / turn_rad;
  const double forward_m = twist.linear_mps * dt_s;
  const double left_m = twist.sideways_mps * dt_s;
  const geometry::Point2 end =
      geometry::to_map(base_in_map, {along * forward_m - across * left_m, across * forward_m + along * left_m});
  return {end.x, end.y, geometry::wrap(base_in_map.yaw + turn_rad)};
}

geometry::Twist2 limit_change(const geometry::Twist2& current, const geometry::Twist2& wanted, const Limits& limits, double dt_s) {
  const double linear = std::clamp(wanted.linear_mps, -limits.max_reverse_mps, limits.max_speed_mps);
  const double angular = std::clamp(wanted.angular_radps, -limits.max_turn_radps, limits.max_turn_radps);
  const double sideways = std::clamp(wanted.sideways_mps, -limits.max_speed_mps, limits.max_speed_mps);
  return {approach(current.linear_mps, linear, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s),
          approach(current.angular_radps, angular, limits.max_turn_acceleration_radps2, limits.max_turn_acceleration_radps2, dt_s),
          approach(current.sideways_mps, sideways, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s)};
}

double stopping_distance_m(double speed_mps, double deceleration_mps2) {
  return speed_mps * speed_mps / (2.0 * deceleration_mps2);
}

}  // namespace aisle::kinematics
