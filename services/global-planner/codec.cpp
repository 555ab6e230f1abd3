#include "services/global-planner/codec.hpp"

#include <utility>

#include "common/wire/geometry.hpp"
#include "common/wire/vehicle.hpp"
#include "services/global-planner/core/fleet_planner.hpp"

namespace aisle::global_planner {
namespace {

using wire::Checks;
using wire::decode;
using wire::Decoded;
using wire::encode;

template <class T>
Decoded<T> checked(const Checks& checks, T value) {
  return checks.ok() ? Decoded<T>(std::move(value)) : Decoded<T>::refused(checks.reason());
}

Navigation::Activity activity(NavigationPhase phase) {
  switch (phase) {
    case NavigationPhase::PHASE_BLOCKED:
      return Navigation::Activity::kBlocked;
    case NavigationPhase::PHASE_ARRIVED:
      return Navigation::Activity::kArrived;
    case NavigationPhase::PHASE_FAILED:
    case NavigationPhase::PHASE_HELD:
      return Navigation::Activity::kStopped;
    default:
      return Navigation::Activity::kUnderway;
  }
}

Navigation::Cause cause(NavigationReason reason) {
  switch (reason) {
    case NavigationReason::REASON_OBSTACLE:
      return Navigation::Cause::kObstacle;
    case NavigationReason::REASON_VEHICLE:
      return Navigation::Cause::kVehicle;
    case NavigationReason::REASON_OFF_PATH:
      return Navigation::Cause::kOffPath;
    default:
      return Navigation::Cause::kOther;
  }
}

}  // namespace

Decoded<VehicleShape> decode(const aisle::VehicleInfo& sample) {
  const auto info = wire::decode(sample);
  return info ? Decoded<VehicleShape>(shape_of(info->footprint, info->limits))
              : Decoded<VehicleShape>::refused(info.reason());
}

Decoded<geometry::Pose2> decode(const aisle::VehicleState& sample) {
  Checks checks;
  checks.id("agv_id", sample.agv_id().to_string());
  const geometry::Pose2 pose = decode(sample.base_in_map(), checks, "base_in_map");
  return checked(checks, pose);
}

Decoded<Goal> decode(const aisle::Goal& sample) {
  Checks checks;
  Goal goal;
  goal.id = sample.goal_id().to_string();
  goal.pose_in_map = decode(sample.pose_in_map(), checks, "pose_in_map");
  goal.position_tolerance_m = sample.position_tolerance_m();
  goal.yaw_tolerance_rad = sample.yaw_tolerance_rad();
  goal.is_cancelled = sample.cancelled();
  checks.id("agv_id", sample.agv_id().to_string())
      .id("goal_id", goal.id)
      .within("position_tolerance_m", goal.position_tolerance_m, 0.0, 100.0)
      .within("yaw_tolerance_rad", goal.yaw_tolerance_rad, 0.0, 7.0);
  return checked(checks, std::move(goal));
}

Decoded<Navigation> decode(const aisle::NavigationStatus& sample) {
  Checks checks;
  checks.id("agv_id", sample.agv_id().to_string())
      .known("phase", sample.phase(), NavigationPhase::PHASE_HELD)
      .known("reason", sample.reason(), NavigationReason::REASON_AUTHORITY)
      .within("blocked_radius_m", sample.blocked_radius_m(), 0.0, 100.0);
  Navigation navigation;
  navigation.goal_id = sample.goal_id().to_string();
  navigation.plan_id = sample.plan_id();
  navigation.blocked_at_in_map = decode(sample.blocked_at_in_map(), checks, "blocked_at_in_map");
  navigation.blocked_radius_m = sample.blocked_radius_m();
  if (!checks.ok()) return Decoded<Navigation>::refused(checks.reason());
  navigation.activity = activity(sample.phase());
  navigation.cause = cause(sample.reason());
  return navigation;
}

Decoded<std::optional<Disc>> decode(const aisle::Track& sample) {
  Checks checks;
  Disc disc;
  disc.center_in_map = decode(sample.position_in_map(), checks, "position_in_map");
  disc.radius_m = sample.radius_m();
  checks.within("radius_m", disc.radius_m, 0.0, 100.0);
  return checked(checks, sample.is_static() ? std::optional<Disc>(disc) : std::nullopt);
}

Decoded<FleetPlan> decode(const aisle::Plan& sample) {
  Checks checks;
  FleetPlan plan;
  plan.agv_id = sample.agv_id().to_string();
  plan.plan_id = sample.plan_id();
  checks.id("agv_id", plan.agv_id)
      .known("outcome", sample.outcome(), PlanOutcome::PLAN_CANCELLED)
      .known("trigger", sample.trigger(), PlanTrigger::TRIGGER_TAKEOVER);
  plan.goal = {sample.goal_id().to_string(), decode(sample.goal_in_map(), checks, "goal_in_map"),
               sample.position_tolerance_m(), sample.yaw_tolerance_rad(),
               sample.outcome() == PlanOutcome::PLAN_CANCELLED};
  plan.map_id = sample.map_id().to_string();
  plan.map_revision = sample.map_revision();
  plan.detail = sample.detail().to_string();
  plan.length_m = sample.length_m();
  checks.within("length_m", plan.length_m, 0.0, 1e9)
      .count("waypoints_in_map", sample.waypoints_in_map().size(), 0, 4096);
  for (const aisle::Point& point : sample.waypoints_in_map())
    plan.waypoints_in_map.push_back(decode(point, checks, "waypoints_in_map"));
  if (!checks.ok()) return Decoded<FleetPlan>::refused(checks.reason());
  plan.outcome = static_cast<FleetOutcome>(sample.outcome());
  plan.trigger = static_cast<Trigger>(sample.trigger());
  return plan;
}

aisle::Plan encode(const FleetPlan& plan, const std::string& planner, double planning_ms) {
  aisle::Plan sample;
  sample.agv_id(plan.agv_id);
  sample.plan_id(plan.plan_id);
  sample.goal_id(plan.goal.id);
  sample.map_id(plan.map_id);
  sample.map_revision(plan.map_revision);
  sample.outcome(static_cast<PlanOutcome>(plan.outcome));
  sample.trigger(static_cast<PlanTrigger>(plan.trigger));
  sample.detail(plan.detail);
  sample.planner(planner);
  geometry::Pose2 ends_in_map = plan.goal.pose_in_map;
  if (plan.is_to_nearest)
    ends_in_map = {plan.waypoints_in_map.back().x, plan.waypoints_in_map.back().y, ends_in_map.yaw};
  sample.goal_in_map(encode(ends_in_map));
  sample.position_tolerance_m(plan.goal.position_tolerance_m);
  sample.yaw_tolerance_rad(plan.goal.yaw_tolerance_rad);
  for (const geometry::Point2 point : plan.waypoints_in_map) sample.waypoints_in_map().push_back(encode(point));
  sample.length_m(plan.length_m);
  sample.planning_ms(planning_ms);
  return sample;
}

}  // namespace aisle::global_planner
