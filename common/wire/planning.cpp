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
constexpr std::size_t kMostDetail = 256;
constexpr double kWidestToleranceM = 100.0;
constexpr double kWidestToleranceRad = 7.0;  // a turn and more
constexpr double kLongestWayM = 1e9;
constexpr double kWidestTubeM = 100.0;
constexpr double kWidestHeadingRad = 3.0 * geometry::kPi;  // as of a pose; it is wrapped

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
    case PlanTrigger::TRIGGER_VEHICLE_BLOCKED:
      return fleet::PlanTrigger::kVehicleBlocked;
    case PlanTrigger::TRIGGER_TAKEOVER:
      return fleet::PlanTrigger::kTakeover;
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

}  // namespace aisle::wire
