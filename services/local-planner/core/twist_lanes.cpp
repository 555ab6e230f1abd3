#include "services/local-planner/core/twist_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/wide_vectors.hpp"
#include "common/kinematics/tricycle.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

double bounded(double value, double low, double high) {
  const double raised = value < low ? low : value;
  return high < raised ? high : raised;
}

/// One axis; `kinematics::approach` without a branch.
AISLE_WIDE_VECTORS void approach(Lane& current, const Lane& wanted, double speed_up, double slow_down, double dt_s) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double now = current[i];
    const double to = wanted[i];
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
    differing += (twists.linear_mps[i] != wanted.linear_mps[i]) | (twists.angular_radps[i] != wanted.angular_radps[i]) |
                         (twists.sideways_mps[i] != wanted.sideways_mps[i])
                     ? 1
                     : 0;
  return differing;
}

namespace {

AISLE_WIDE_VECTORS void bound(const Lane& values, double low, double high, Lane& bounded_values) {
  for (std::size_t i = 0; i < kLanes; ++i) bounded_values[i] = bounded(values[i], low, high);
}

}  // namespace

void follow_differential(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits, double dt_s) {
  Lane to;
  bound(wanted.linear_mps, -limits.max_reverse_mps, limits.max_speed_mps, to);
  approach(twists.linear_mps, to, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s);
  bound(wanted.angular_radps, -limits.max_turn_radps, limits.max_turn_radps, to);
  approach(twists.angular_radps, to, limits.max_turn_acceleration_radps2, limits.max_turn_acceleration_radps2, dt_s);
  twists.sideways_mps.fill(0.0);
}

SteeringLanes::SteeringLanes(const kinematics::Limits& limits, double steering_rad, const TwistLanes& wanted) {
  if (limits.model != kinematics::Model::kTricycle) return;
  steering_rad_.fill(steering_rad);
  tangent_.fill(std::tan(steering_rad));
  for (std::size_t i = 0; i < kLanes; ++i)
    target_rad_[i] = kinematics::steering_for_rad(limits.axle, wanted.at(i), steering_rad);
}

void SteeringLanes::follow_all(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits,
                               double dt_s) {
  turn(limits.axle.max_steering_rate_radps * dt_s);
  drive(twists, wanted, limits, dt_s);
}

void SteeringLanes::follow(TwistLanes& twists, const TwistLanes& wanted, const kinematics::Limits& limits,
                           double dt_s) {
  const SteeringLanes before = *this;
  const TwistLanes twists_before = twists;
  follow_all(twists, wanted, limits, dt_s);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const bool is_there = twists_before.linear_mps[i] == wanted.linear_mps[i] &&
                          twists_before.angular_radps[i] == wanted.angular_radps[i] &&
                          twists_before.sideways_mps[i] == wanted.sideways_mps[i];
    if (!is_there) continue;
    twists.set(i, twists_before.at(i));
    steering_rad_[i] = before.steering_rad_[i];
    tangent_[i] = before.tangent_[i];
  }
}

/// Tangents are asked for anew only where a wheel turned, and once of neighbours that turned alike.
void SteeringLanes::turn(double most_rad) {
  is_turning_ = false;
  double last_rad = steering_rad_[0], last_tangent = tangent_[0];
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double next_rad = steering_rad_[i] + bounded(target_rad_[i] - steering_rad_[i], -most_rad, most_rad);
    if (next_rad == steering_rad_[i]) continue;
    is_turning_ = true;
    if (next_rad != last_rad) last_rad = next_rad, last_tangent = std::tan(next_rad);
    steering_rad_[i] = last_rad;
    tangent_[i] = last_tangent;
  }
}

/// Where the wheel is turned so far that the vehicle would turn too fast it drives slower.
AISLE_WIDE_VECTORS void SteeringLanes::drive(TwistLanes& twists, const TwistLanes& wanted,
                                             const kinematics::Limits& limits, double dt_s) const {
  const double wheelbase_m = limits.axle.wheelbase_m, sign = limits.axle.is_rear ? -1.0 : 1.0;
  Lane to;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double per_metre = std::abs(tangent_[i] / wheelbase_m);
    const double fastest_mps = per_metre > 1e-9 ? limits.max_turn_radps / per_metre : 1e9;
    to[i] = bounded(wanted.linear_mps[i], -least(limits.max_reverse_mps, fastest_mps),
                    least(limits.max_speed_mps, fastest_mps));
  }
  approach(twists.linear_mps, to, limits.max_acceleration_mps2, limits.max_deceleration_mps2, dt_s);
  for (std::size_t i = 0; i < kLanes; ++i)
    twists.angular_radps[i] = sign * (twists.linear_mps[i] * tangent_[i] / wheelbase_m);
  twists.sideways_mps.fill(0.0);
}

AISLE_WIDE_VECTORS void driven_m(const TwistLanes& twists, double swing_m, double dt_s, Lane& driven_m) {
  int sideways = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double along_mps = twists.linear_mps[i], across_mps = swing_m * twists.angular_radps[i];
    driven_m[i] = std::sqrt(along_mps * along_mps + across_mps * across_mps) * dt_s;
    sideways += twists.sideways_mps[i] != 0.0 ? 1 : 0;
  }
  if (sideways == 0) return;
  for (std::size_t i = 0; i < kLanes; ++i)
    driven_m[i] = speed_of(twists.at(i)) * dt_s + swing_m * std::abs(twists.angular_radps[i]) * dt_s;
}

}  // namespace aisle::local_planner
