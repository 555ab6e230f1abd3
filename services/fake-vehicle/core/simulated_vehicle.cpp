#include "services/fake-vehicle/core/simulated_vehicle.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::fake_vehicle {
namespace {

constexpr time::Stamp kStep = std::chrono::milliseconds(5);
constexpr std::size_t kMostQueued = 64;
constexpr double kStandMps = 1e-3;
constexpr double kTouchM = 1e-6;

/// Without the tail of the exponential that never ends.
double settle(double speed, double wanted) { return std::abs(speed - wanted) < kStandMps ? wanted : speed; }

}  // namespace

SimulatedVehicle::SimulatedVehicle(const Parameters& parameters, const geometry::Pose2& start_in_map)
    : parameters_(parameters), base_in_map_(start_in_map) {}

void SimulatedVehicle::command(const geometry::Twist2& twist, time::Stamp arrived) {
  commanded_ = true;
  last_command_ = arrived;
  if (queued_.size() == kMostQueued) queued_.pop_front();
  queued_.push_back({twist, arrived + time::from_seconds(parameters_.dead_time_s)});
}

void SimulatedVehicle::advance_to(time::Stamp now, const Surroundings& around) {
  if (!started_ || now - time_ > kLongestGap) time_ = started_ ? now - kStep : now;
  started_ = true;
  while (time_ < now) {
    const time::Stamp next = std::min(now, time_ + kStep);
    step(next, time::seconds(next - time_), around);
    time_ = next;
  }
}

void SimulatedVehicle::step(time::Stamp now, double dt_s, const Surroundings& around) {
  while (!queued_.empty() && queued_.front().effective <= now) {
    wanted_ = queued_.front().twist;
    queued_.pop_front();
  }
  const bool silent = !commanded_ || now - last_command_ > time::from_seconds(parameters_.command_timeout_s);
  if (silent) {
    queued_.clear();
    wanted_ = {};
    twist_ = brake(dt_s);
    hold_ = commanded_ ? Hold::kLateCommand : Hold::kNoCommand;
  } else {
    twist_ = follow(dt_s);
    if (hold_ != Hold::kContact) hold_ = Hold::kNone;
  }
  move(dt_s, around);
}

geometry::Twist2 SimulatedVehicle::follow(double dt_s) const {
  const double share = parameters_.lag_s > 0.0 ? 1.0 - std::exp(-dt_s / parameters_.lag_s) : 1.0;
  const geometry::Twist2 lagged{twist_.linear_mps + share * (wanted_.linear_mps - twist_.linear_mps),
                                twist_.angular_radps + share * (wanted_.angular_radps - twist_.angular_radps), 0.0};
  geometry::Twist2 next = kinematics::limit_change(twist_, lagged, parameters_.limits, dt_s);
  next.linear_mps = settle(next.linear_mps, std::clamp(wanted_.linear_mps, -parameters_.limits.max_reverse_mps, parameters_.limits.max_speed_mps));
  next.angular_radps = settle(next.angular_radps, std::clamp(wanted_.angular_radps, -parameters_.limits.max_turn_radps, parameters_.limits.max_turn_radps));
  return next;
}

geometry::Twist2 SimulatedVehicle::brake(double dt_s) const { return kinematics::limit_change(twist_, {}, parameters_.limits, dt_s); }

void SimulatedVehicle::move(double dt_s, const Surroundings& around) {
  if (twist_.linear_mps == 0.0) {
    base_in_map_.yaw = geometry::wrap(base_in_map_.yaw + twist_.angular_radps * dt_s);
    if (hold_ == Hold::kContact && wanted_.linear_mps == 0.0) hold_ = Hold::kNone;
    return;
  }
  const geometry::Pose2 next = kinematics::advance(base_in_map_, twist_, dt_s);
  const double look_m = geometry::distance(next.position(), base_in_map_.position()) + kTouchM;
  const double gap_next_m = gap_m(around, next.position(), parameters_.radius_m, look_m);
  const bool nearer = gap_next_m < look_m && gap_next_m < gap_m(around, base_in_map_.position(), parameters_.radius_m, look_m) + kTouchM;
  if (gap_next_m >= 0.0 || !nearer) {
    base_in_map_ = next;
    if (hold_ == Hold::kContact && !nearer) hold_ = Hold::kNone;
    return;
  }
  if (hold_ != Hold::kContact) ++contacts_;
  hold_ = Hold::kContact;
  base_in_map_.yaw = next.yaw;
  twist_.linear_mps = 0.0;
}

geometry::Pose2 with_noise(const geometry::Pose2& base_in_map, const Parameters& parameters, std::mt19937_64& random) {
  std::normal_distribution<double> unit(0.0, 1.0);
  const double x = unit(random);
  const double y = unit(random);
  const double yaw = unit(random);
  return {base_in_map.x + parameters.pose_noise_m * x, base_in_map.y + parameters.pose_noise_m * y,
          geometry::wrap(base_in_map.yaw + parameters.yaw_noise_rad * yaw)};
}

}  // namespace aisle::fake_vehicle
