#include "common/kinematics/differential.hpp"

#include <algorithm>

#include "common/kinematics/axis.hpp"

namespace aisle::kinematics {

/// Both axes by themselves.
geometry::Twist2 limit_change_differential(const geometry::Twist2& current, const geometry::Twist2& wanted,
                                           const Limits& limits, double dt_s) {
  const double linear = std::clamp(wanted.linear_mps, -limits.max_reverse_mps, limits.max_speed_mps);
  const double angular = std::clamp(wanted.angular_radps, -limits.max_turn_radps, limits.max_turn_radps);

  return {approach(current.linear_mps, linear, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s),
          approach(current.angular_radps, angular, limits.max_turn_acceleration_radps2,
                   limits.max_turn_acceleration_radps2, dt_s),
          0.0};
}

}  // namespace aisle::kinematics
