#include "tools/sim/drive_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::sim {
namespace {

constexpr double kStatePeriodS = 0.02;
constexpr double kTurningRadps = 0.05;  // slower turns are noise
constexpr double kMovingMps = 0.02;
constexpr double kLeaderlessS = 1.0;  // without a beat of the leader
constexpr double kSilentS = 2.0;      // a vehicle that says nothing for longer is dead
constexpr std::uint64_t kFnvPrime = 1099511628211ULL;

/// The number's IEEE 754 bits, so that equal hashes mean equal to the bit.
std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

DriveRecorder::DriveRecorder(service::Shell& shell) : begun_(shell.now()) {
  shell.inbox<topics::WorldObstacle>(
      [this](const fleet::Obstacle& obstacle, const service::Sender& from) { take(obstacle, from.by.stamp_ns); });
  shell.inbox<topics::VehicleState>([this](const fleet::VehicleState& state) { take(state); });
  shell.inbox<topics::Plan>([this](const fleet::Plan& plan) { take(plan); });

  shell.inbox<topics::Goal>([this](const fleet::Goal& goal) { vehicles_[goal.agv_id].goal = goal; });
  shell.inbox<topics::Grant>([this](const fleet::Grant& grant) { vehicles_[grant.agv_id].grant = grant; });
  shell.inbox<topics::TrafficStatus>(
      [this](const fleet::TrafficStatus&, const service::Sender& from) { leader_heard_ = from.arrived; });
  shell.inbox<topics::NavigationStatus>([this](const fleet::NavigationStatus& status, const service::Sender& from) {
    VehicleEntry& vehicle = vehicles_[status.agv_id];
    vehicle.navigation = status;
    vehicle.navigation_arrived = from.arrived;

    // Soon after, it may be moved out of the way, and names no goal then.
    const bool has_ended = status.phase == fleet::Phase::kArrived || status.phase == fleet::Phase::kFailed;
    if (has_ended && !status.goal_id.empty()) vehicle.ended_goal = status.goal_id;
  });
}

void DriveRecorder::take(const fleet::Obstacle& obstacle, std::int64_t stamp_ns) {
  const geometry::Pose2& base = obstacle.base_in_map;
  for (const std::uint64_t bits :
       {static_cast<std::uint64_t>(stamp_ns), bits_of(base.x), bits_of(base.y), bits_of(base.yaw)})
    trace_hash_ = (trace_hash_ ^ bits) * kFnvPrime;

  // Metres, of vehicles: on whose way were they?
  if (obstacle.kind != fleet::Obstacle::Kind::kVehicle) return;
  VehicleEntry& vehicle = vehicles_[obstacle.id];
  const double moved_m = vehicle.place_in_map ? geometry::distance(*vehicle.place_in_map, base.position()) : 0.0;
  vehicle.place_in_map = base.position();
  if (!vehicle.plan.is_found() || vehicle.plan.waypoints_in_map.empty()) return;

  plan_way_m_ += moved_m;
  if (is_on_own_way(vehicle)) own_way_m_ += moved_m;
}

/// Jerk is the second difference of the speed over two periods; a turn's sign changes between two turns beyond
/// kTurningRadps, whatever lies in between.
void DriveRecorder::take(const fleet::VehicleState& state) {
  VehicleEntry& vehicle = vehicles_[state.agv_id];
  const double mps = state.motion.twist.linear_mps;
  vehicle.is_moving = std::abs(mps) > kMovingMps || std::abs(state.motion.twist.sideways_mps) > kMovingMps ||
                      std::abs(state.motion.twist.angular_radps) > kTurningRadps;
  vehicle.is_held = state.hold == fleet::Hold::kPerson;
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
  vehicle.plan = plan;
  if (!plan.is_found() || vehicle.planned_goal == plan.goal_id) return;

  vehicle.planned_goal = plan.goal_id;

  const std::vector<geometry::Point2>& way = plan.waypoints_in_map;
  for (std::size_t i = 1; i < way.size(); ++i) planned_m_ += geometry::distance(way[i - 1], way[i]);
}

bool DriveRecorder::is_on_own_way(const VehicleEntry& vehicle) {
  const fleet::Plan& plan = vehicle.plan;
  if (plan.own_steps.empty() || !vehicle.navigation) return true;

  const std::uint64_t done = std::max(vehicle.navigation->step_done, plan.first_step);
  const auto step = std::min<std::uint64_t>(done - plan.first_step, plan.own_steps.size() - 1);
  return plan.own_steps[static_cast<std::size_t>(step)] != 0;
}

/// A vehicle is excused whose reason lies outside the fleet: something in its way, a person that holds it, no map or
/// tracker, no word from itself.
Doing DriveRecorder::doing(VehicleEntry& vehicle, time::Stamp now) {
  Doing doing;
  if (!vehicle.goal || vehicle.goal->is_cancelled || !vehicle.navigation) return doing;

  using fleet::Phase;
  using fleet::Reason;
  const fleet::NavigationStatus& says = *vehicle.navigation;
  const bool is_silent = now - vehicle.navigation_arrived > time::from_seconds(kSilentS);

  doing.has_open_goal = vehicle.ended_goal != vehicle.goal->id;
  doing.is_moving = vehicle.is_moving;
  doing.is_excused = is_silent || vehicle.is_held || says.reason == Reason::kObstacle ||
                     says.reason == Reason::kNoMap || says.reason == Reason::kNoState ||
                     says.reason == Reason::kStaleState || says.reason == Reason::kNoTracker ||
                     says.reason == Reason::kStaleTracker;

  doing.waits_for = vehicle.grant.waits_for;

  // A vehicle that is about to go on says nothing of why it stood.
  const bool goes_on = says.phase == Phase::kDriving || says.phase == Phase::kTurning || says.phase == Phase::kAvoiding;
  if (!goes_on || doing.is_moving) {
    vehicle.stands_because = std::string(name(says.phase)) + ", " + name(says.reason);
    if (!vehicle.grant.reason.empty()) vehicle.stands_because += ", " + vehicle.grant.reason;
  }
  doing.reason = vehicle.stands_because;

  return doing;
}

void DriveRecorder::look(time::Stamp now) {
  const bool has_no_leader = leader_heard_ && now - *leader_heard_ > time::from_seconds(kLeaderlessS);

  std::map<std::string, Doing> fleet;
  for (auto& [agv_id, vehicle] : vehicles_) {
    fleet[agv_id] = doing(vehicle, now);
    if (has_no_leader) fleet[agv_id].is_excused = true;
  }

  standoffs_.look(time::seconds(now - begun_), fleet);
}

void DriveRecorder::fill(Result& result) const {
  const auto words = [](const LongestStand& stand) {
    return stand.agv_id.empty() ? std::string{}
                                : fmt::format("{} from {:.1f} s: {}", stand.agv_id, stand.begin_s, stand.cause);
  };
  result.longest_standoff_s = standoffs_.longest_standoff().seconds;
  result.longest_standoff = words(standoffs_.longest_standoff());
  result.longest_wait_s = standoffs_.longest_wait().seconds;
  result.longest_wait = words(standoffs_.longest_wait());
  result.own_way_m = own_way_m_;
  result.plan_way_m = plan_way_m_;

  result.planned_m = planned_m_;
  result.turn_sign_changes = turn_sign_changes_;
  result.jerk_squared_sum = jerk_squared_sum_;
  result.jerk_samples = jerk_samples_;
  result.trace_hash = trace_hash_;
}

}  // namespace aisle::sim
