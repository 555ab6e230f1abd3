#include "services/local-planner/core/command_following.hpp"

#include <algorithm>
#include <cmath>

#include "common/kinematics/tricycle.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

constexpr double kSpeedErrorMps = 0.1;  // of what is measured
constexpr double kResponseS = 0.35;     // the wheels may lag behind a command by what they change in this time,
constexpr double kBrakingLagMps = 0.1;  // and by so much more while they brake
constexpr double kArcMps = 0.01;        // a slower vehicle drives along no arc

}  // namespace

CommandFollower::CommandFollower(const Settings& settings)
    : control_period_s_(settings.control_period_s),
      dead_time_s_(settings.surroundings.dead_time_s),
      stale_state_s_(settings.stale_state_s) {}

void CommandFollower::restart(const time::Latest<Motion>& state) {
  in_force_ = state.seen() ? state.any()->twist : Twist2{};
}

OwnMotion CommandFollower::observe(const Vehicle& vehicle, const time::Latest<Motion>& state, time::Stamp now) {
  const Motion* newest = state.any();
  if (newest == nullptr) return {};
  OwnMotion motion;

  // Now: the state carried on by its own twist. Then: carried on by the command in force, for the dead time.
  const double age_s = std::clamp(time::seconds(now - state.arrived()), 0.0, stale_state_s_);
  motion.base_now = kinematics::advance(newest->base_in_map, newest->twist, age_s);
  motion.base_then = kinematics::advance(motion.base_now, in_force_, dead_time_s_);

  motion.measured_mps = newest->twist.linear_mps;

  // The command before this one is what the wheels are following, unless the vehicle does something else. An old state
  // does not tell which.
  const double slack_mps = kSpeedErrorMps + kResponseS * vehicle.limits.max_acceleration_mps2;
  if (state.fresh(now, time::from_seconds(stale_state_s_)))
    in_force_.linear_mps = std::clamp(in_force_.linear_mps, motion.measured_mps - slack_mps - kBrakingLagMps,
                                      motion.measured_mps + slack_mps);

  // The wheel of a vehicle that stands is where it was measured, whatever turned it; one that was told to move is where
  // it was told to go.
  if (motion.stands() && in_force_.linear_mps == 0.0) steering_rad_ = newest->steering_rad;

  if (!vehicle.turns_on_the_spot())
    in_force_.angular_radps = kinematics::turn_rate_radps(vehicle.limits.axle, in_force_.linear_mps, steering_rad_);

  return motion;
}

Twist2 CommandFollower::braking(const kinematics::Limits& limits) const {
  const double v = in_force_.linear_mps;
  const double next = std::max(0.0, v - limits.max_deceleration_mps2 * control_period_s_);

  return {0.0, v > kArcMps ? in_force_.angular_radps * next / v : 0.0, 0.0};
}

const Twist2& CommandFollower::follow(const Twist2& wanted, const kinematics::Limits& limits) {
  const kinematics::DriveState next = kinematics::follow({in_force_, steering_rad_}, wanted, limits, control_period_s_);
  in_force_ = next.twist;
  steering_rad_ = next.steering_rad;

  return in_force_;
}

}  // namespace aisle::local_planner
