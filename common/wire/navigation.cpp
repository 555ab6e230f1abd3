#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "common/wire/geometry.hpp"
#include "common/wire/planning.hpp"

namespace aisle::wire {
namespace {

// Sizes are those of the IDL.
constexpr std::size_t kMostIntent = 64;
constexpr std::size_t kMostHeld = 32;
constexpr std::size_t kMostDetail = 256;
constexpr double kLongestWayM = 1e9;
constexpr double kFarthestStrayM = 1e6;
constexpr double kLongestIntentS = 3600.0;
constexpr double kLargestBlockM = 100.0;

/// As in planning.cpp: exhaustive both ways; from_wire gives none for a number that is no enumerator.
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

/// What a vehicle says of its steps and of the grant that it obeys.
void decode_traffic(const aisle::NavigationStatus& sample, Checks& checks, fleet::NavigationStatus& status) {
  status.progress_m = sample.progress_m();
  status.step_done = sample.step_done();
  status.limit_step = sample.limit_step();
  status.limit_m = sample.limit_m();

  status.grant_number = sample.grant_number();
  status.traffic_epoch = sample.traffic_epoch();
  status.heard_beat = sample.heard_beat();
  status.traffic_boot_id = sample.traffic_boot_id();
  status.grant_boot_id = sample.grant_boot_id();

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
  sample.traffic_boot_id(status.traffic_boot_id);
  sample.grant_boot_id(status.grant_boot_id);

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
