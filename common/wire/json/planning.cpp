#include "common/wire/json/parts.hpp"

namespace aisle::wire {
namespace {

constexpr std::array kPlanOutcomes{"found",      "no_path",     "start_blocked", "goal_blocked",
                                   "out_of_map", "out_of_time", "cancelled"};
constexpr std::array kTriggers{"new_goal", "map_changed", "track", "vehicle_blocked", "takeover"};
constexpr std::array kPhases{"waiting", "turning", "driving", "avoiding", "blocked", "arrived", "failed", "held"};
constexpr std::array kReasons{"none",        "no_goal",       "no_map",        "no_plan",  "no_state", "no_tracker",
                              "stale_state", "stale_tracker", "plan_outdated", "obstacle", "vehicle",  "yielding",
                              "off_path",    "unreachable",   "cancelled",     "late",     "authority"};

Json json_of_intent(const aisle::IntentPoint& point) {
  return Json{{"offset_s", point.offset_s()}, {"base_in_map", to_json(point.base_in_map())}};
}

std::string name_of(aisle::PlanOutcome outcome) { return enumerator_name(kPlanOutcomes, outcome); }
std::string name_of(aisle::NavigationPhase phase) { return enumerator_name(kPhases, phase); }
std::string name_of(aisle::NavigationReason reason) { return enumerator_name(kReasons, reason); }

}  // namespace

Json to_json(const aisle::Goal& sample) {
  return Json{{"agv_id", sample.agv_id().to_string()},
              {"by", to_json(sample.by())},
              {"goal_id", sample.goal_id().to_string()},
              {"pose_in_map", to_json(sample.pose_in_map())},
              {"position_tolerance_m", sample.position_tolerance_m()},
              {"yaw_tolerance_rad", sample.yaw_tolerance_rad()},
              {"cancelled", sample.cancelled()}};
}

Json to_json(const aisle::Plan& sample) {
  return Json{{"agv_id", sample.agv_id().to_string()},
              {"by", to_json(sample.by())},
              {"plan_id", sample.plan_id()},
              {"goal_id", sample.goal_id().to_string()},
              {"map_id", sample.map_id().to_string()},
              {"map_revision", sample.map_revision()},
              {"outcome", name_of(sample.outcome())},
              {"trigger", enumerator_name(kTriggers, sample.trigger())},
              {"detail", sample.detail().to_string()},
              {"planner", sample.planner().to_string()},
              {"goal_in_map", to_json(sample.goal_in_map())},
              {"position_tolerance_m", sample.position_tolerance_m()},
              {"yaw_tolerance_rad", sample.yaw_tolerance_rad()},
              {"waypoints_in_map", array_of(sample.waypoints_in_map())},
              {"length_m", sample.length_m()},
              {"planning_ms", sample.planning_ms()}};
}

Json to_json(const aisle::NavigationStatus& sample) {
  Json intent = Json::array();
  for (const aisle::IntentPoint& point : sample.intent()) intent.push_back(json_of_intent(point));
  return Json{{"agv_id", sample.agv_id().to_string()},
              {"by", to_json(sample.by())},
              {"goal_id", sample.goal_id().to_string()},
              {"plan_id", sample.plan_id()},
              {"map_revision", sample.map_revision()},
              {"phase", name_of(sample.phase())},
              {"reason", name_of(sample.reason())},
              {"detail", sample.detail().to_string()},
              {"distance_left_m", sample.distance_left_m()},
              {"time_left_s", sample.time_left_s()},
              {"blocked_at_in_map", to_json(sample.blocked_at_in_map())},
              {"blocked_radius_m", sample.blocked_radius_m()},
              {"control_ms", sample.control_ms()},
              {"intent", std::move(intent)}};
}

}  // namespace aisle::wire
