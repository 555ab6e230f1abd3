#include "services/fake-vehicle/core/simulated_vehicle.hpp"

#include <algorithm>
#include <cmath>

#include "common/kinematics/tricycle.hpp"

namespace aisle::fake_vehicle {
namespace {

constexpr time::Stamp kStep = std::chrono::milliseconds(5);
constexpr std::size_t kMostQueued = 64;  // commands within the dead time
constexpr double kStandMps = 1e-3;       // nearer than this to the wanted speed, it is reached
constexpr double kTouchM = 1e-6;         // a gap that shrinks by less has not shrunk

/// The wanted speed once it is near: an exponential alone would never get there.
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

  // Silence longer than the time-out drops even what was still queued.
  const bool silent = !commanded_ || now - last_command_ > time::from_seconds(parameters_.command_timeout_s);
  if (silent) {
    queued_.clear();
    wanted_ = {};
    drive_ = brake(dt_s);
    hold_ = commanded_ ? Hold::kLateCommand : Hold::kNoCommand;
  } else if (hindrance_.is_held) {
    drive_ = brake(dt_s);
    hold_ = Hold::kPerson;
  } else {
    drive_ = follow(dt_s);
    if (hold_ != Hold::kContact) hold_ = Hold::kNone;
  }

  move(dt_s, around);
}

kinematics::DriveState SimulatedVehicle::follow(double dt_s) const {
  kinematics::Limits limits = parameters_.limits;
  limits.max_speed_mps *= hindrance_.speed_share;
  limits.max_reverse_mps *= hindrance_.speed_share;
  const geometry::Twist2& twist = drive_.twist;

  // First-order lag: v(t + dt) = v + (1 - e^(-dt / lag)) (v_wanted - v), an axis.
  const double share = parameters_.lag_s > 0.0 ? 1.0 - std::exp(-dt_s / parameters_.lag_s) : 1.0;
  geometry::Twist2 lagged{twist.linear_mps + share * (wanted_.linear_mps - twist.linear_mps),
                          twist.angular_radps + share * (wanted_.angular_radps - twist.angular_radps),
                          twist.sideways_mps + share * (wanted_.sideways_mps - twist.sideways_mps)};

  // Only the drive of a tricycle lags; its wheel turns to the steering angle of the command's arc.
  if (limits.model == kinematics::Model::kTricycle)
    lagged.angular_radps = kinematics::turn_rate_radps(
        limits.axle, lagged.linear_mps, kinematics::steering_for_rad(limits.axle, wanted_, drive_.steering_rad));

  // Limits of speed, acceleration and steering.
  kinematics::DriveState next = kinematics::follow(drive_, lagged, limits, dt_s);

  // Last, snap to the wanted speeds, as far as the limits allow them.
  next.twist.linear_mps =
      settle(next.twist.linear_mps, std::clamp(wanted_.linear_mps, -limits.max_reverse_mps, limits.max_speed_mps));

  if (limits.model == kinematics::Model::kTricycle) {
    next.twist.angular_radps = kinematics::turn_rate_radps(limits.axle, next.twist.linear_mps, next.steering_rad);
    return next;
  }

  next.twist.angular_radps = settle(next.twist.angular_radps,
                                    std::clamp(wanted_.angular_radps, -limits.max_turn_radps, limits.max_turn_radps));
  if (limits.model == kinematics::Model::kOmnidirectional)
    next.twist.sideways_mps = settle(next.twist.sideways_mps, wanted_.sideways_mps);

  return next;
}

kinematics::DriveState SimulatedVehicle::brake(double dt_s) const {
  return kinematics::follow(drive_, {}, parameters_.limits, dt_s);
}

void SimulatedVehicle::move(double dt_s, const Surroundings& around) {
  geometry::Twist2& twist = drive_.twist;
  const geometry::Footprint footprint = parameters_.footprint();

  // A disc on the spot, and a vehicle that stands, cannot press into anything.
  const bool is_on_the_spot = twist.linear_mps == 0.0 && twist.sideways_mps == 0.0;

  if (is_on_the_spot && (footprint.is_disc() || twist.angular_radps == 0.0)) {
    base_in_map_.yaw = geometry::wrap(base_in_map_.yaw + twist.angular_radps * dt_s);
    if (hold_ == Hold::kContact && wanted_.linear_mps == 0.0) hold_ = Hold::kNone;
    return;
  }

  // Look as far as any point of the body moves in this step; what is farther away cannot come nearer than that.
  const geometry::Pose2 next = kinematics::advance(base_in_map_, twist, dt_s);
  const double swing_m =
      footprint.is_disc() ? 0.0 : std::abs(twist.angular_radps) * dt_s * geometry::reach_m(footprint);
  const double look_m = geometry::distance(next.position(), base_in_map_.position()) + swing_m + kTouchM;
  const double gap_next_m = gap_m(around, geometry::body_of(footprint, next), look_m);

  // It may overlap already, after a wall was drawn on it: then it may move wherever the gap does not shrink.
  const bool nearer =
      gap_next_m < look_m && gap_next_m < gap_m(around, geometry::body_of(footprint, base_in_map_), look_m) + kTouchM;
  if (gap_next_m >= 0.0 || !nearer) {
    base_in_map_ = next;
    if (hold_ == Hold::kContact && !nearer) hold_ = Hold::kNone;
    return;
  }

  // Blocked: it stands. A disc may go on turning.
  if (hold_ != Hold::kContact) ++contacts_;
  hold_ = Hold::kContact;

  if (footprint.is_disc()) base_in_map_.yaw = next.yaw;

  const double turn_radps = footprint.is_disc() ? twist.angular_radps : 0.0;
  twist = {0.0, turn_radps, 0.0};
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
