#include "common/kinematics/vehicle_model.hpp"

#include <cmath>

#include "common/kinematics/differential.hpp"
#include "common/kinematics/omnidirectional.hpp"
#include "common/kinematics/tricycle.hpp"

namespace aisle::kinematics {

/// along = sin(a) / a and across = (1 - cos(a)) / a, of the equation in the header.
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

/// Each model has a file of its own.
DriveState follow(const DriveState& current, const geometry::Twist2& wanted, const Limits& limits, double dt_s) {
  switch (limits.model) {
    case Model::kOmnidirectional:
      return {limit_change_omnidirectional(current.twist, wanted, limits, dt_s), 0.0};
    case Model::kTricycle: {
      const TricycleState next =
          limit_change_tricycle({current.twist.linear_mps, current.steering_rad}, wanted, limits, dt_s);
      return {{next.speed_mps, turn_rate_radps(limits.axle, next.speed_mps, next.steering_rad), 0.0},
              next.steering_rad};
    }

    case Model::kDifferential:
      break;
  }

  return {limit_change_differential(current.twist, wanted, limits, dt_s), 0.0};
}

/// The steering angle of the current motion follows from its twist.
geometry::Twist2 limit_change(const geometry::Twist2& current, const geometry::Twist2& wanted, const Limits& limits,
                              double dt_s) {
  const double steering = limits.model == Model::kTricycle ? steering_for_rad(limits.axle, current, 0.0) : 0.0;
  return follow({current, steering}, wanted, limits, dt_s).twist;
}

double least_turning_radius_m(const Limits& limits) {
  return limits.model == Model::kTricycle ? least_radius_m(limits.axle) : 0.0;
}

double stopping_distance_m(double speed_mps, double deceleration_mps2) {
  return speed_mps * speed_mps / (2.0 * deceleration_mps2);
}

}  // namespace aisle::kinematics
