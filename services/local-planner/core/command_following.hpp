#pragma once

#include "common/kinematics/vehicle_model.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/settings.hpp"

namespace aisle::local_planner {

/// The twist in force: the command before this cycle's, bounded by what the vehicle was measured to do. From it follow
/// where the vehicle will be when the next command acts, and what the next command can be.
///
///   state ─► observe ─► in_force ─► (the other parts choose what is wanted) ─► follow ─► in_force, the command
class CommandFollower {
 public:
  explicit CommandFollower(const Settings& settings);

  /// The vehicle has braked by itself meanwhile: its measured twist is in force; without a state, none.
  void restart(const time::Latest<Motion>& state);

  /// Carries the newest state on to `now` and to when the next command acts, and bounds the twist in force by it. The
  /// zero motion where no state was seen.
  OwnMotion observe(const Vehicle& vehicle, const time::Latest<Motion>& state, time::Stamp now);

  /// In the vehicle's frame.
  const geometry::Twist2& in_force() const { return in_force_; }

  /// Angle in rad of a tricycle's wheel after the last command; to the left.
  double steering_rad() const { return steering_rad_; }

  /// The twist to ask for, to brake along the arc that is being driven.
  geometry::Twist2 braking(const kinematics::Limits& limits) const;

  /// The motion nearest to `wanted` that the limits let the vehicle reach in one control period; now in force.
  const geometry::Twist2& follow(const geometry::Twist2& wanted, const kinematics::Limits& limits);

 private:
  double control_period_s_;
  double dead_time_s_;
  double stale_state_s_;

  geometry::Twist2 in_force_;
  double steering_rad_{0.0};
};

}  // namespace aisle::local_planner
