#include "tools/sim/drive_recorder.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::sim {
namespace {

constexpr double kStatePeriodS = 0.02;
constexpr double kTurningRadps = 0.05;  // slower turns are noise
constexpr std::uint64_t kFnvPrime = 1099511628211ULL;

/// The number's IEEE 754 bits, so that equal hashes mean equal to the bit.
std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

DriveRecorder::DriveRecorder(service::Shell& shell) {
  shell.inbox<topics::WorldObstacle>(
      [this](const fleet::Obstacle& obstacle, const service::Sender& from) { take(obstacle, from.by.stamp_ns); });
  shell.inbox<topics::VehicleState>([this](const fleet::VehicleState& state) { take(state); });
  shell.inbox<topics::Plan>([this](const fleet::Plan& plan) { take(plan); });
}

void DriveRecorder::take(const fleet::Obstacle& obstacle, std::int64_t stamp_ns) {
  const geometry::Pose2& base = obstacle.base_in_map;
  for (const std::uint64_t bits :
       {static_cast<std::uint64_t>(stamp_ns), bits_of(base.x), bits_of(base.y), bits_of(base.yaw)})
    trace_hash_ = (trace_hash_ ^ bits) * kFnvPrime;
}

/// Jerk is the second difference of the speed over two periods; a turn's sign changes between two turns beyond
/// kTurningRadps, whatever lies in between.
void DriveRecorder::take(const fleet::VehicleState& state) {
  VehicleEntry& vehicle = vehicles_[state.agv_id];
  const double mps = state.motion.twist.linear_mps;
  const double mps2 = vehicle.has_state ? (mps - vehicle.mps) / kStatePeriodS : 0.0;
  const double jerk = (mps2 - vehicle.mps2) / kStatePeriodS;

  jerk_squared_sum_ += jerk * jerk;
  ++jerk_samples_;
  vehicle.has_state = true;
  vehicle.mps = mps;
  vehicle.mps2 = mps2;

  const double turn_radps = state.motion.twist.angular_radps;
  if (std::abs(turn_radps) <= kTurningRadps) return;

  if (turn_radps * vehicle.turn_radps < 0.0) ++turn_sign_changes_;
  vehicle.turn_radps = turn_radps;
}

/// The length of the first plan for each goal.
void DriveRecorder::take(const fleet::Plan& plan) {
  VehicleEntry& vehicle = vehicles_[plan.agv_id];
  if (!plan.is_found() || vehicle.planned_goal == plan.goal_id) return;

  vehicle.planned_goal = plan.goal_id;

  const std::vector<geometry::Point2>& way = plan.waypoints_in_map;
  for (std::size_t i = 1; i < way.size(); ++i) planned_m_ += geometry::distance(way[i - 1], way[i]);
}

void DriveRecorder::fill(Result& result) const {
  result.planned_m = planned_m_;
  result.turn_sign_changes = turn_sign_changes_;
  result.jerk_squared_sum = jerk_squared_sum_;
  result.jerk_samples = jerk_samples_;
  result.trace_hash = trace_hash_;
}

}  // namespace aisle::sim
