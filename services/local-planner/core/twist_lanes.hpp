#pragma once
#include "common/kinematics/limits.hpp"
#include "services/local-planner/core/lanes.hpp"

namespace aisle::local_planner {

/// Twists side by side.
struct TwistLanes {
  alignas(32) Lane linear_mps, angular_radps, sideways_mps;

  TwistLanes() = default;
  explicit TwistLanes(const geometry::Twist2& all);
  /// The last of them again where there are fewer than lanes. @pre count > 0
  TwistLanes(const geometry::Twist2* twists, std::size_t count);
  geometry::Twist2 at(std::size_t i) const { return {linear_mps[i], angular_radps[i], sideways_mps[i]}; }
  void set(std::size_t i, const geometry::Twist2& twist) {
    linear_mps[i] = twist.linear_mps, angular_radps[i] = twist.angular_radps, sideways_mps[i] = twist.sideways_mps;
  }
};

/// How many of the twists are not what is wanted.
int count_differing(const TwistLanes& twists, const TwistLanes& wanted);

/// `kinematics::follow` of a differential drive in every lane, to the bit. @pre `limits.model` is kDifferential
void follow_differential(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits, double dt_s);

/// The steered wheels of tricycles; `kinematics::follow` of a tricycle in every lane, to the bit.
class SteeringLanes {
 public:
  /// Nothing to do for other models.
  SteeringLanes(const kinematics::Limits& limits, double steering_rad, const TwistLanes& wanted);
  /// @pre `limits.model` is kTricycle, `wanted` is what it was made with
  void follow_all(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits, double dt_s);
  /// The same but in lanes whose twist is what is wanted already.
  void follow(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits, double dt_s);
  /// Did a wheel turn in the last step?
  bool is_turning() const { return is_turning_; }

 private:
  void turn(double most_rad);
  void drive(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits, double dt_s) const;

  Lane target_rad_, steering_rad_, tangent_;
  bool is_turning_{false};
};

/// What the farthest point of each vehicle drives in a step, at most: the base's way and `swing_m` of its turn, in
/// metres.
void driven_m(const TwistLanes& twists, double swing_m, double dt_s, Lane& driven_m);

}  // namespace aisle::local_planner
