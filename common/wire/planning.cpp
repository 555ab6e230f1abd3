#include "common/wire/planning.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "common/wire/geometry.hpp"

namespace aisle::wire {
namespace {

// Sizes are those of the IDL.
constexpr std::size_t kMostWaypoints = 4096;
constexpr std::size_t kMostSteps = 4096;
constexpr std::size_t kMostIntent = 64;
constexpr std::size_t kMostHeld = 32;
constexpr std::size_t kMostDetail = 256;
constexpr double kWidestToleranceM = 100.0;
constexpr double kWidestToleranceRad = 7.0;  // a turn and more
constexpr double kLongestWayM = 1e9;
constexpr double kWidestTubeM = 100.0;
constexpr double kFarthestStrayM = 1e6;
constexpr double kWidestHeadingRad = 3.0 * geometry::kPi;  // as of a pose; it is wrapped
constexpr double kLongestIntentS = 3600.0;
constexpr double kLargestBlockM = 100.0;

/// Enumerators are translated by exhaustive switches: one that is added to either enum does not compile
/// here until it is translated. from_wire: none for a number that is no enumerator, e.g. of a newer
/// program.
aisle::PlanOutcome to_wire(fleet::PlanOutcome value) {
  switch (value) {
    case fleet::PlanOutcome::kFound:
      return PlanOutcome::PLAN_FOUND;
    case fleet::PlanOutcome::kNoPath:
      return PlanOutcome::PLAN_NO_PATH;
    case fleet::PlanOutcome::kStartBlocked:
      return PlanOutcome::PLAN_START_BLOCKED;
    case fleet::PlanOutcome::kGoalBlocked:
      return PlanOutcome::PLAN_GOAL_BLOCKED;
    case fleet::PlanOutcome::kOutOfMap:
      return PlanOutcome::PLAN_OUT_OF_MAP;
    case fleet::PlanOutcome::kOutOfTime:
      return PlanOutcome::PLAN_OUT_OF_TIME;
    case fleet::PlanOutcome::kCancelled:
      return PlanOutcome::PLAN_CANCELLED;
  }

  return {};
}

std::optional<fleet::PlanOutcome> from_wire(aisle::PlanOutcome value) {
  switch (value) {
    case PlanOutcome::PLAN_FOUND:
      return fleet::PlanOutcome::kFound;
    case PlanOutcome::PLAN_NO_PATH:
      return fleet::PlanOutcome::kNoPath;
    case PlanOutcome::PLAN_START_BLOCKED:
      return fleet::PlanOutcome::kStartBlocked;
    case PlanOutcome::PLAN_GOAL_BLOCKED:
      return fleet::PlanOutcome::kGoalBlocked;
    case PlanOutcome::PLAN_OUT_OF_MAP:
      return fleet::PlanOutcome::kOutOfMap;
    case PlanOutcome::PLAN_OUT_OF_TIME:
      return fleet::PlanOutcome::kOutOfTime;
    case PlanOutcome::PLAN_CANCELLED:
      return fleet::PlanOutcome::kCancelled;
  }

  return std::nullopt;
}

aisle::PlanTrigger to_wire(fleet::PlanTrigger value) {
  switch (value) {
    case fleet::PlanTrigger::kNewGoal:
      return PlanTrigger::TRIGGER_NEW_GOAL;
    case fleet::PlanTrigger::kMapChanged:
      return PlanTrigger::TRIGGER_MAP_CHANGED;
    case fleet::PlanTrigger::kTrack:
      return PlanTrigger::TRIGGER_TRACK;
    case fleet::PlanTrigger::kVehicleBlocked:
      return PlanTrigger::TRIGGER_VEHICLE_BLOCKED;
    case fleet::PlanTrigger::kTakeover:
      return PlanTrigger::TRIGGER_TAKEOVER;
  }

  return {};
}

std::optional<fleet::PlanTrigger> from_wire(aisle::PlanTrigger value) {
  switch (value) {
    case PlanTrigger::TRIGGER_NEW_GOAL:
      return fleet::PlanTrigger::kNewGoal;
    case PlanTrigger::TRIGGER_MAP_CHANGED:
      return fleet::PlanTrigger::kMapChanged;
    case PlanTrigger::TRIGGER_TRACK:
      return fleet::PlanTrigger::kTrack;
    case PlanTrigger::TRIGGER_VEHICLE_BLOCKED:
      return fleet::PlanTrigger::kVehicleBlocked;
    case PlanTrigger::TRIGGER_TAKEOVER:
      return fleet::PlanTrigger::kTakeover;
  }

  return std::nullopt;
}

aisle::NavigationPhase to_wire(fleet::Phase value) {
  switch (value) {
    case fleet::Phase::kWaiting:
      return NavigationPhase::PHASE_WAITING;
    case fleet::Phase::kTurning:
      return NavigationPhase::PHASE_TURNING;
    case fleet::Phase::kDriving:
      return NavigationPhase::PHASE_DRIVING;
    case fleet::Phase::kAvoiding:
      return NavigationPhase::PHASE_AVOIDING;
    case fleet::Phase::kBlocked:
      return NavigationPhase::PHASE_BLOCKED;
    case fleet::Phase::kArrived:
      return NavigationPhase::PHASE_ARRIVED;
    case fleet::Phase::kFailed:
      return NavigationPhase::PHASE_FAILED;
    case fleet::Phase::kHeld:
      return NavigationPhase::PHASE_HELD;
  }

  return {};
}

std::optional<fleet::Phase> from_wire(aisle::NavigationPhase value) {
  switch (value) {
    case NavigationPhase::PHASE_WAITING:
      return fleet::Phase::kWaiting;
    case NavigationPhase::PHASE_TURNING:
      return fleet::Phase::kTurning;
    case NavigationPhase::PHASE_DRIVING:
      return fleet::Phase::kDriving;
    case NavigationPhase::PHASE_AVOIDING:
      return fleet::Phase::kAvoiding;
    case NavigationPhase::PHASE_BLOCKED:
      return fleet::Phase::kBlocked;
    case NavigationPhase::PHASE_ARRIVED:
      return fleet::Phase::kArrived;
    case NavigationPhase::PHASE_FAILED:
      return fleet::Phase::kFailed;
    case NavigationPhase::PHASE_HELD:
      return fleet::Phase::kHeld;
  }

  return std::nullopt;
}

aisle::NavigationReason to_wire(fleet::Reason value) {
  switch (value) {
    case fleet::Reason::kNone:
      return NavigationReason::REASON_NONE;
    case fleet::Reason::kNoGoal:
      return NavigationReason::REASON_NO_GOAL;
    case fleet::Reason::kNoMap:
      return NavigationReason::REASON_NO_MAP;
    case fleet::Reason::kNoPlan:
      return NavigationReason::REASON_NO_PLAN;
    case fleet::Reason::kNoState:
      return NavigationReason::REASON_NO_STATE;
    case fleet::Reason::kNoTracker:
      return NavigationReason::REASON_NO_TRACKER;
    case fleet::Reason::kStaleState:
      return NavigationReason::REASON_STALE_STATE;
    case fleet::Reason::kStaleTracker:
      return NavigationReason::REASON_STALE_TRACKER;
    case fleet::Reason::kPlanOutdated:
      return NavigationReason::REASON_PLAN_OUTDATED;
    case fleet::Reason::kObstacle:
      return NavigationReason::REASON_OBSTACLE;
    case fleet::Reason::kVehicle:
      return NavigationReason::REASON_VEHICLE;
    case fleet::Reason::kYielding:
      return NavigationReason::REASON_YIELDING;
    case fleet::Reason::kOffPath:
      return NavigationReason::REASON_OFF_PATH;
    case fleet::Reason::kUnreachable:
      return NavigationReason::REASON_UNREACHABLE;
    case fleet::Reason::kCancelled:
      return NavigationReason::REASON_CANCELLED;
    case fleet::Reason::kLate:
      return NavigationReason::REASON_LATE;
    case fleet::Reason::kAuthority:
      return NavigationReason::REASON_AUTHORITY;
    case fleet::Reason::kNoGrant:
      return NavigationReason::REASON_NO_GRANT;
    case fleet::Reason::kPerson:
      return NavigationReason::REASON_PERSON;
  }

  return {};
}

std::optional<fleet::Reason> from_wire(aisle::NavigationReason value) {
  switch (value) {
    case NavigationReason::REASON_NONE:
      return fleet::Reason::kNone;
    case NavigationReason::REASON_NO_GOAL:
      return fleet::Reason::kNoGoal;
    case NavigationReason::REASON_NO_MAP:
      return fleet::Reason::kNoMap;
    case NavigationReason::REASON_NO_PLAN:
      return fleet::Reason::kNoPlan;
    case NavigationReason::REASON_NO_STATE:
      return fleet::Reason::kNoState;
    case NavigationReason::REASON_NO_TRACKER:
      return fleet::Reason::kNoTracker;
    case NavigationReason::REASON_STALE_STATE:
      return fleet::Reason::kStaleState;
    case NavigationReason::REASON_STALE_TRACKER:
      return fleet::Reason::kStaleTracker;
    case NavigationReason::REASON_PLAN_OUTDATED:
      return fleet::Reason::kPlanOutdated;
    case NavigationReason::REASON_OBSTACLE:
      return fleet::Reason::kObstacle;
    case NavigationReason::REASON_VEHICLE:
      return fleet::Reason::kVehicle;
    case NavigationReason::REASON_YIELDING:
      return fleet::Reason::kYielding;
    case NavigationReason::REASON_OFF_PATH:
      return fleet::Reason::kOffPath;
    case NavigationReason::REASON_UNREACHABLE:
      return fleet::Reason::kUnreachable;
    case NavigationReason::REASON_CANCELLED:
      return fleet::Reason::kCancelled;
    case NavigationReason::REASON_LATE:
      return fleet::Reason::kLate;
    case NavigationReason::REASON_AUTHORITY:
      return fleet::Reason::kAuthority;
    case NavigationReason::REASON_NO_GRANT:
      return fleet::Reason::kNoGrant;
    case NavigationReason::REASON_PERSON:
      return fleet::Reason::kPerson;
  }

  return std::nullopt;
}

/// The steps, after the waypoints were read. Their ends do not fall; there is a heading a waypoint, or none.
void decode_steps(const aisle::Plan& sample, Checks& checks, fleet::Plan& plan) {
  const std::size_t waypoints = plan.waypoints_in_map.size();
  plan.first_step = sample.first_step();
  plan.tube_m = sample.tube_m();

  checks.count("step_ends_m", sample.step_ends_m().size(), 0, waypoints == 0 ? 0 : kMostSteps)
      .within("tube_m", plan.tube_m, 0.0, kWidestTubeM)
      .count("headings_rad", sample.headings_rad().size(), sample.headings_rad().empty() ? 0 : waypoints, waypoints)
      .count("own_steps", sample.own_steps().size(), sample.own_steps().empty() ? 0 : sample.step_ends_m().size(),
             sample.step_ends_m().size());
  if (!checks.ok()) return;

  double before_m = 0.0;
  for (const double end_m : sample.step_ends_m()) {
    checks.within("step_ends_m", end_m, before_m, kLongestWayM);
    before_m = end_m;
  }
  plan.step_ends_m = sample.step_ends_m();

  for (const std::uint8_t is_own : sample.own_steps()) checks.within("own_steps", is_own, 0, 1);
  plan.own_steps = sample.own_steps();

  plan.headings_rad.reserve(sample.headings_rad().size());
  for (const double heading_rad : sample.headings_rad()) {
    checks.within("headings_rad", heading_rad, -kWidestHeadingRad, kWidestHeadingRad);
    plan.headings_rad.push_back(geometry::wrap(heading_rad));
  }
}

/// What a vehicle says of its steps and of the grant that it obeys.
void decode_traffic(const aisle::NavigationStatus& sample, Checks& checks, fleet::NavigationStatus& status) {
  status.progress_m = sample.progress_m();
  status.step_done = sample.step_done();
  status.limit_step = sample.limit_step();
  status.limit_m = sample.limit_m();

  status.grant_number = sample.grant_number();
  status.traffic_epoch = sample.traffic_epoch();
  status.heard_beat = sample.heard_beat();

  status.stray_m = sample.stray_m();
  status.wants_room = sample.wants_room();

  checks.within("progress_m", status.progress_m, 0.0, kLongestWayM)
      .within("limit_m", status.limit_m, 0.0, kLongestWayM)
      .within("stray_m", status.stray_m, 0.0, kFarthestStrayM)
      .count("held", sample.held().size(), 0, kMostHeld);
  if (!checks.ok()) return;

  std::uint64_t before = 0;
  for (const aisle::HeldPose& held : sample.held()) {
    checks.holds(held.step() >= before, "held.step falls");
    before = held.step();
    status.held.push_back({decode(held.base_in_map(), checks, "held.base_in_map"), held.step()});
  }
}

}  // namespace

aisle::Goal encode(const fleet::Goal& goal) {
  aisle::Goal sample;
  sample.agv_id(goal.agv_id);
  sample.goal_id(goal.id);

  sample.pose_in_map(encode(goal.pose_in_map));
  sample.position_tolerance_m(goal.position_tolerance_m);
  sample.yaw_tolerance_rad(goal.yaw_tolerance_rad);
  sample.cancelled(goal.is_cancelled);

  return sample;
}

Decoded<fleet::Goal> decode(const aisle::Goal& sample) {
  Checks checks;
  fleet::Goal goal;

  goal.agv_id = sample.agv_id().to_string();
  goal.id = sample.goal_id().to_string();

  goal.pose_in_map = decode(sample.pose_in_map(), checks, "pose_in_map");
  goal.position_tolerance_m = sample.position_tolerance_m();
  goal.yaw_tolerance_rad = sample.yaw_tolerance_rad();
  goal.is_cancelled = sample.cancelled();

  checks.id("agv_id", goal.agv_id)
      .id("goal_id", goal.id)
      .within("position_tolerance_m", goal.position_tolerance_m, 0.0, kWidestToleranceM)
      .within("yaw_tolerance_rad", goal.yaw_tolerance_rad, 0.0, kWidestToleranceRad);

  return checks.decoded(std::move(goal));
}

aisle::Plan encode(const fleet::Plan& plan) {
  aisle::Plan sample;
  sample.agv_id(plan.agv_id);
  sample.plan_id(plan.id);
  sample.goal_id(plan.goal_id);
  sample.map_id(plan.map_id);
  sample.map_revision(plan.map_revision);

  sample.outcome(to_wire(plan.outcome));
  sample.trigger(to_wire(plan.trigger));
  sample.detail(plan.detail.substr(0, kMostDetail));
  sample.planner(plan.planner);

  sample.goal_in_map(encode(plan.goal_in_map));
  sample.position_tolerance_m(plan.position_tolerance_m);
  sample.yaw_tolerance_rad(plan.yaw_tolerance_rad);

  sample.waypoints_in_map().reserve(plan.waypoints_in_map.size());
  for (const geometry::Point2 point : plan.waypoints_in_map) sample.waypoints_in_map().push_back(encode(point));

  sample.length_m(plan.length_m);
  sample.planning_ms(plan.planning_ms);

  sample.first_step(plan.first_step);
  sample.step_ends_m(plan.step_ends_m);
  sample.tube_m(plan.tube_m);
  sample.headings_rad().reserve(plan.headings_rad.size());
  for (const double heading_rad : plan.headings_rad) sample.headings_rad().push_back(geometry::wrap(heading_rad));
  sample.own_steps(plan.own_steps);

  return sample;
}

/// A plan that was found has at least one waypoint; waypoints and steps are read last, since there may be many.
Decoded<fleet::Plan> decode(const aisle::Plan& sample) {
  Checks checks;
  fleet::Plan plan;

  plan.agv_id = sample.agv_id().to_string();
  plan.id = sample.plan_id();
  plan.goal_id = sample.goal_id().to_string();
  plan.map_id = sample.map_id().to_string();
  plan.map_revision = sample.map_revision();

  plan.outcome = checks.known("outcome", sample.outcome(), from_wire(sample.outcome()));
  plan.trigger = checks.known("trigger", sample.trigger(), from_wire(sample.trigger()));
  plan.detail = sample.detail().to_string();
  plan.planner = sample.planner().to_string();

  plan.goal_in_map = decode(sample.goal_in_map(), checks, "goal_in_map");
  plan.position_tolerance_m = sample.position_tolerance_m();
  plan.yaw_tolerance_rad = sample.yaw_tolerance_rad();

  plan.length_m = sample.length_m();
  plan.planning_ms = sample.planning_ms();

  checks.id("agv_id", plan.agv_id)
      .optional_id("goal_id", plan.goal_id)
      .optional_id("map_id", plan.map_id)
      .optional_id("planner", plan.planner)
      .within("position_tolerance_m", plan.position_tolerance_m, 0.0, kWidestToleranceM)
      .within("yaw_tolerance_rad", plan.yaw_tolerance_rad, 0.0, kWidestToleranceRad)
      .within("length_m", plan.length_m, 0.0, kLongestWayM)
      .finite("planning_ms", plan.planning_ms)
      .count("waypoints_in_map", sample.waypoints_in_map().size(), plan.is_found() ? 1 : 0, kMostWaypoints);

  if (!checks.ok()) return Decoded<fleet::Plan>::refused(checks.reason());

  plan.waypoints_in_map.reserve(sample.waypoints_in_map().size());

  for (const aisle::Point& point : sample.waypoints_in_map())
    plan.waypoints_in_map.push_back(decode(point, checks, "waypoints_in_map"));

  decode_steps(sample, checks, plan);

  return checks.decoded(std::move(plan));
}

aisle::NavigationStatus encode(const fleet::NavigationStatus& status) {
  aisle::NavigationStatus sample;
  sample.agv_id(status.agv_id);
  sample.goal_id(status.goal_id);
  sample.plan_id(status.plan_id);
  sample.map_revision(status.map_revision);

  sample.phase(to_wire(status.phase));
  sample.reason(to_wire(status.reason));
  sample.detail(status.detail.substr(0, kMostDetail));

  sample.distance_left_m(status.distance_left_m);
  sample.time_left_s(status.time_left_s);

  sample.blocked_at_in_map(encode(status.blocked_at_in_map));
  sample.blocked_radius_m(status.blocked_radius_m);

  sample.control_ms(status.control_ms);

  for (std::size_t i = 0; i < std::min(status.intent.size(), kMostIntent); ++i) {
    aisle::IntentPoint point;
    point.offset_s(status.intent[i].offset_s);
    point.base_in_map(encode(status.intent[i].base_in_map));
    sample.intent().push_back(point);
  }

  sample.progress_m(status.progress_m);
  sample.step_done(status.step_done);
  sample.limit_step(status.limit_step);
  sample.limit_m(status.limit_m);

  sample.grant_number(status.grant_number);
  sample.traffic_epoch(status.traffic_epoch);
  sample.heard_beat(status.heard_beat);

  sample.stray_m(status.stray_m);
  sample.wants_room(status.wants_room);

  for (const fleet::HeldPose& held : status.held) {
    aisle::HeldPose pose;
    pose.base_in_map(encode(held.base_in_map));
    pose.step(held.step);
    sample.held().push_back(pose);
  }

  return sample;
}

/// Offsets of the intent begin at 0 or later and do not fall.
Decoded<fleet::NavigationStatus> decode(const aisle::NavigationStatus& sample) {
  Checks checks;
  fleet::NavigationStatus status;

  status.agv_id = sample.agv_id().to_string();
  status.goal_id = sample.goal_id().to_string();
  status.plan_id = sample.plan_id();
  status.map_revision = sample.map_revision();

  status.phase = checks.known("phase", sample.phase(), from_wire(sample.phase()));
  status.reason = checks.known("reason", sample.reason(), from_wire(sample.reason()));
  status.detail = sample.detail().to_string();

  status.distance_left_m = sample.distance_left_m();
  status.time_left_s = sample.time_left_s();

  status.blocked_at_in_map = decode(sample.blocked_at_in_map(), checks, "blocked_at_in_map");
  status.blocked_radius_m = sample.blocked_radius_m();
  status.control_ms = sample.control_ms();

  checks.id("agv_id", status.agv_id)
      .optional_id("goal_id", status.goal_id)
      .finite("distance_left_m", status.distance_left_m)
      .finite("time_left_s", status.time_left_s)
      .within("blocked_radius_m", status.blocked_radius_m, 0.0, kLargestBlockM)
      .finite("control_ms", status.control_ms)
      .count("intent", sample.intent().size(), 0, kMostIntent);

  if (!checks.ok()) return Decoded<fleet::NavigationStatus>::refused(checks.reason());

  double before_s = 0.0;
  for (const aisle::IntentPoint& point : sample.intent()) {
    checks.within("intent.offset_s", point.offset_s(), before_s, kLongestIntentS);
    before_s = point.offset_s();
    status.intent.push_back({point.offset_s(), decode(point.base_in_map(), checks, "intent.base_in_map")});
  }

  decode_traffic(sample, checks, status);

  return checks.decoded(std::move(status));
}

}  // namespace aisle::wire
