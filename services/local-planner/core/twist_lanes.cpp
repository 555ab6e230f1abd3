#include "services/local-planner/core/twist_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/wide_vectors.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

double bounded(double value, double low, double high) {
  const double raised = value < low ? low : value;
  return high < raised ? high : raised;
}

/// One axis; `kinematics::approach` without a branch.
AISLE_WIDE_VECTORS void approach(Lane& current, const Lane& wanted, double lowest, double highest, double speed_up, double slow_down, double dt_s) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double now = current[i];
    const double to = bounded(wanted[i], lowest, highest);
    const double stop_s = std::abs(now) / slow_down;
    const double braked = now - std::copysign(slow_down * dt_s, now);
    const double reversed = std::copysign(least(std::abs(to), speed_up * (dt_s - stop_s)), to);
    const double through_zero = stop_s >= dt_s ? braked : reversed;
    const double change = (std::abs(to) < std::abs(now) ? slow_down : speed_up) * dt_s;
    const double nearer = now + bounded(to - now, -change, change);
    current[i] = now * to < 0.0 ? through_zero : nearer;
  }
}

}  // namespace

TwistLanes::TwistLanes(const Twist2& all) {
  linear_mps.fill(all.linear_mps);
  angular_radps.fill(all.angular_radps);
  sideways_mps.fill(all.sideways_mps);
}

TwistLanes::TwistLanes(const Twist2* twists, std::size_t count) {
  for (std::size_t i = 0; i < kLanes; ++i) set(i, twists[std::min(i, count - 1)]);
}

AISLE_WIDE_VECTORS int count_differing(const TwistLanes& twists, const TwistLanes& wanted) {
  int differing = 0;
  for (std::size_t i = 0; i < kLanes; ++i)
    differing += (twists.linear_mps[i] != wanted.linear_mps[i]) | (twists.angular_radps[i] != wanted.angular_radps[i]) | (twists.sideways_mps[i] != wanted.sideways_mps[i]) ? 1 : 0;
  return differing;
}

void follow_differential(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits, double dt_s) {
  approach(twists.linear_mps, wanted.linear_mps, -limits.max_reverse_mps, limits.max_speed_mps, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s);
  approach(twists.angular_radps, wanted.angular_radps, -limits.max_turn_radps, limits.max_turn_radps, limits.max_turn_acceleration_radps2,
           limits.max_turn_acceleration_radps2, dt_s);
  twists.sideways_mps.fill(0.0);
}

AISLE_WIDE_VECTORS void driven_m(const TwistLanes& twists, double swing_m, double dt_s, Lane& driven_m) {
  int sideways = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    driven_m[i] = std::abs(twists.linear_mps[i]) * dt_s + swing_m * std::abs(twists.angular_radps[i]) * dt_s;
    sideways += twists.sideways_mps[i] != 0.0 ? 1 : 0;
  }
  if (sideways == 0) return;
  for (std::size_t i = 0; i < kLanes; ++i) driven_m[i] = speed_of(twists.at(i)) * dt_s + swing_m * std::abs(twists.angular_radps[i]) * dt_s;
}

}  // namespace aisle::local_planner
