#include "services/local-planner/core/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/kinematics/tricycle.hpp"

namespace aisle::local_planner {

using geometry::Batch;
using geometry::BatchMask;
using geometry::clamped;
using geometry::least;
using geometry::magnitude;
using geometry::Twist2;
using geometry::with_sign;

namespace {

/// `kinematics::approach` without a branch: from `now` towards `to` for `dt_s`; through zero by braking first.
[[gnu::always_inline]] inline Batch approached(const Batch& now, const Batch& to, double speed_up, double slow_down,
                                               double dt_s) {
  // Against the present direction: brake to zero, then speed up for what is left of the step.
  const Batch stop_s = magnitude(now) / slow_down;
  const Batch braked = now - with_sign(Batch{} + slow_down * dt_s, now);
  const Batch reversed = with_sign(least<Batch>(magnitude(to), speed_up * (dt_s - stop_s)), to);
  const Batch through_zero = stop_s >= dt_s ? braked : reversed;

  // In the same direction: by at most one step's change.
  const Batch change = magnitude(to) < magnitude(now) ? Batch{} + slow_down * dt_s : Batch{} + speed_up * dt_s;
  const Batch nearer = now + clamped<Batch>(to - now, -change, change);

  return now * to < 0.0 ? through_zero : nearer;
}

/// Which samples have another twist.
[[gnu::always_inline]] inline BatchMask differs(const Twist<Batch>& a, const Twist<Batch>& b) {
  return (a.linear_mps != b.linear_mps) | (a.angular_radps != b.angular_radps) | (a.sideways_mps != b.sideways_mps);
}

}  // namespace

double speed_of(const Twist2& twist) {
  return twist.sideways_mps == 0.0 ? std::abs(twist.linear_mps) : std::hypot(twist.linear_mps, twist.sideways_mps);
}

TwistBlock::TwistBlock(const Twist2& all) {
  for (Twist<Batch>& batch : batches)
    batch = {Batch{} + all.linear_mps, Batch{} + all.angular_radps, Batch{} + all.sideways_mps};
}

TwistBlock::TwistBlock(const Twist2* twists, std::size_t count) {
  for (std::size_t i = 0; i < kBlock; ++i) set(i, twists[std::min(i, count - 1)]);
}

AISLE_BATCHED bool differ(const TwistBlock& a, const TwistBlock& b) {
  BatchMask found{};
  for (std::size_t k = 0; k < kBatches; ++k) found |= differs(a.batches[k], b.batches[k]);
  return geometry::any(found);
}

AISLE_BATCHED bool goes_sideways(const TwistBlock& twists) {
  BatchMask found{};
  for (const Twist<Batch>& batch : twists.batches) found |= batch.sideways_mps != 0.0;
  return geometry::any(found);
}

ArcBlock::ArcBlock(const geometry::Pose2& base_in_map) {
  Arc<Batch> begin;
  begin.begin(base_in_map);
  std::fill(std::begin(batches), std::end(batches), begin);
}

AISLE_BATCHED void ArcBlock::set_steps(const TwistBlock& twists, double dt_s) {
  sideways = goes_sideways(twists);
  for (std::size_t b = 0; b < kBatches; ++b) batches[b].set_step(twists.batches[b], dt_s);
}

AISLE_BATCHED void ArcBlock::step() {
  const bool also_sideways = sideways;
  for (Arc<Batch>& arc : batches) arc.step(also_sideways);
}

AISLE_BATCHED void follow_differential(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits,
                                       double dt_s) {
  const double most_mps = limits.max_speed_mps;
  const double least_mps = -limits.max_reverse_mps;
  const double most_radps = limits.max_turn_radps;
  const double speed_up = limits.max_acceleration_mps2;
  const double slow_down = limits.max_deceleration_mps2;
  const double turn_up = limits.max_turn_acceleration_radps2;

  for (std::size_t b = 0; b < kBatches; ++b) {
    Twist<Batch>& twist = twists.batches[b];
    const Batch to_mps = clamped(wanted.batches[b].linear_mps, least_mps, most_mps);
    const Batch to_radps = clamped(wanted.batches[b].angular_radps, -most_radps, most_radps);

    twist.linear_mps = approached(twist.linear_mps, to_mps, speed_up, slow_down, dt_s);
    twist.angular_radps = approached(twist.angular_radps, to_radps, turn_up, turn_up, dt_s);
    twist.sideways_mps = Batch{};
  }
}

SteeringBlock::SteeringBlock(const kinematics::Limits& limits, double steering_rad, const TwistBlock& wanted) {
  if (limits.model != kinematics::Model::kTricycle) return;
  steering_rad_.fill(steering_rad);
  tangent_.fill(std::tan(steering_rad));
  for (std::size_t i = 0; i < kBlock; ++i)
    target_rad_[i] = kinematics::steering_for_rad(limits.axle, wanted.at(i), steering_rad);
}

void SteeringBlock::follow_all(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits,
                               double dt_s) {
  turn(limits.axle.max_steering_rate_radps * dt_s);
  drive(twists, wanted, limits, dt_s);
}

AISLE_BATCHED void SteeringBlock::follow(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits,
                                         double dt_s) {
  const SteeringBlock before = *this;
  const TwistBlock twists_before = twists;
  follow_all(twists, wanted, limits, dt_s);

  for (std::size_t b = 0; b < kBatches; ++b) {
    Twist<Batch>& after = twists.batches[b];
    const Twist<Batch>& was = twists_before.batches[b];
    const BatchMask moves_on = differs(was, wanted.batches[b]);
    after.linear_mps = moves_on ? after.linear_mps : was.linear_mps;
    after.angular_radps = moves_on ? after.angular_radps : was.angular_radps;
    after.sideways_mps = moves_on ? after.sideways_mps : was.sideways_mps;
    steering_rad_.put(b, moves_on ? steering_rad_.batch(b) : before.steering_rad_.batch(b));
    tangent_.put(b, moves_on ? tangent_.batch(b) : before.tangent_.batch(b));
  }
}

/// The tangent is computed anew only where a wheel turned, and once for neighbours that turned alike.
void SteeringBlock::turn(double most_rad) {
  is_turning_ = false;
  double last_rad = steering_rad_[0];
  double last_tangent = tangent_[0];

  for (std::size_t i = 0; i < kBlock; ++i) {
    const double next_rad = steering_rad_[i] + clamped<double>(target_rad_[i] - steering_rad_[i], -most_rad, most_rad);
    if (next_rad == steering_rad_[i]) continue;

    is_turning_ = true;
    if (next_rad != last_rad) {
      last_rad = next_rad;
      last_tangent = std::tan(next_rad);
    }

    steering_rad_[i] = last_rad;
    tangent_[i] = last_tangent;
  }
}

/// Where the wheel is turned so far that the vehicle would turn faster than its limit, it drives slower.
AISLE_BATCHED void SteeringBlock::drive(TwistBlock& twists, const TwistBlock& wanted, const kinematics::Limits& limits,
                                        double dt_s) const {
  constexpr double kStraightPerM = 1e-9;  // a curvature below this limits no speed
  constexpr double kNoLimitMps = std::numeric_limits<double>::infinity();
  const double wheelbase_m = limits.axle.wheelbase_m;
  const double sign = limits.axle.is_rear ? -1.0 : 1.0;
  const double most_radps = limits.max_turn_radps, speed_up = limits.max_acceleration_mps2,
               slow_down = limits.max_deceleration_mps2;

  const Batch most_mps = Batch{} + limits.max_speed_mps;
  const Batch most_reverse_mps = Batch{} + limits.max_reverse_mps;
  for (std::size_t b = 0; b < kBatches; ++b) {
    Twist<Batch>& twist = twists.batches[b];
    const Batch tangent = tangent_.batch(b);
    const Batch per_metre = magnitude(tangent / wheelbase_m);
    const Batch fastest_mps = per_metre > kStraightPerM ? most_radps / per_metre : Batch{} + kNoLimitMps;
    const Batch to_mps = clamped<Batch>(wanted.batches[b].linear_mps, -least(most_reverse_mps, fastest_mps),
                                        least(most_mps, fastest_mps));

    twist.linear_mps = approached(twist.linear_mps, to_mps, speed_up, slow_down, dt_s);
    twist.angular_radps = sign * (twist.linear_mps * tangent / wheelbase_m);
    twist.sideways_mps = Batch{};
  }
}

AISLE_BATCHED void find_driven_m(const TwistBlock& twists, double swing_m, double dt_s, PerSample& driven_m) {
  BatchMask sideways{};
  for (std::size_t b = 0; b < kBatches; ++b) {
    const Twist<Batch>& twist = twists.batches[b];
    const Batch along_mps = twist.linear_mps;
    const Batch across_mps = swing_m * twist.angular_radps;
    driven_m.put(b, geometry::square_root(along_mps * along_mps + across_mps * across_mps) * dt_s);
    sideways |= twist.sideways_mps != 0.0;
  }

  // Sideways as well, one by one.
  if (!geometry::any(sideways)) return;

  for (std::size_t i = 0; i < kBlock; ++i)
    driven_m[i] = speed_of(twists.at(i)) * dt_s + swing_m * std::abs(twists.at(i).angular_radps) * dt_s;
}

}  // namespace aisle::local_planner
