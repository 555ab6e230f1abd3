#pragma once

namespace aisle::kinematics {

/// How a vehicle can move; order and meaning of the IDL's KinematicModel.
enum class Model { kDifferential, kOmnidirectional, kTricycle };

/// The steered wheel of a tricycle. The vehicle's frame lies in the middle of its fixed axle.
struct SteeredAxle {
  double wheelbase_m{1.5};
  double max_steering_rad{1.2};  // to either side, less than a quarter turn
  double max_steering_rate_radps{0.8};
  bool is_rear{false};  // the steered wheel trails the fixed axle (counterbalance forklifts), else it leads

  template <class Reader>
  void describe(Reader& r) {
    r.field("wheelbase_m", wheelbase_m, 0.1, 10.0)
        .field("max_steering_rad", max_steering_rad, 0.05, 1.5)
        .field("max_steering_rate_radps", max_steering_rate_radps, 0.05, 20.0)
        .field("is_rear", is_rear);
  }
};

/// What a vehicle can do, in metres, radians and seconds. Magnitudes: all are >= 0. Speed up and slow
/// down have limits of their own; the bounds in describe() are those of configuration files.
struct Limits {
  double max_speed_mps{1.2};
  double max_reverse_mps{0.3};
  double max_turn_radps{1.2};
  double max_acceleration_mps2{0.8};
  double max_deceleration_mps2{1.2};
  double max_turn_acceleration_radps2{2.5};
  Model model{Model::kDifferential};
  SteeredAxle axle{};  // of a tricycle

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

}  // namespace aisle::kinematics
