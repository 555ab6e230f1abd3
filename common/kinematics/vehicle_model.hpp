#pragma once
#include "common/geometry/pose.hpp"

namespace aisle::kinematics {

/// What a vehicle can do. Magnitudes: all are >= 0.
struct Limits {
  double max_speed_mps{1.2};
  double max_reverse_mps{0.3};
  double max_turn_radps{1.2};
  double max_acceleration_mps2{0.8};
  double max_deceleration_mps2{1.2};
  double max_turn_acceleration_radps2{2.5};

  template <class Reader>
  void describe(Reader& r) {
    r.field("max_speed_mps", max_speed_mps, 0.05, 10.0)
        .field("max_reverse_mps", max_reverse_mps, 0.0, 10.0)
        .field("max_turn_radps", max_turn_radps, 0.05, 10.0)
        .field("max_acceleration_mps2", max_acceleration_mps2, 0.05, 20.0)
        .field("max_deceleration_mps2", max_deceleration_mps2, 0.05, 20.0)
        .field("max_turn_acceleration_radps2", max_turn_acceleration_radps2, 0.05, 50.0);
  }
};

/// Pose after driving with a constant twist for `dt_s` (exact arc, not an Euler step).
geometry::Pose2 advance(const geometry::Pose2& base_in_map, const geometry::Twist2& twist, double dt_s);

/// The twist nearest to `wanted` that `limits` let a vehicle reach from `current` within `dt_s`.
/// Speeding up uses the acceleration, slowing down the deceleration limit.
geometry::Twist2 limit_change(const geometry::Twist2& current, const geometry::Twist2& wanted, const Limits& limits, double dt_s);

/// Metres to a stand from this speed.
double stopping_distance_m(double speed_mps, double deceleration_mps2);

}  // namespace aisle::kinematics
