#include "common/wire/json/parts.hpp"

namespace aisle::wire {
namespace {

constexpr std::array kFootprints{"disc", "rectangle"};
constexpr std::array kModels{"differential", "omnidirectional", "tricycle"};
constexpr std::array kHolds{"none", "no_command", "late_command", "contact", "duplicate_id"};
constexpr std::array kBodies{"vehicle", "person", "block"};

std::string name_of(aisle::HoldReason reason) { return enumerator_name(kHolds, reason); }

}  // namespace

Json to_json(const aisle::VehicleInfo& sample) {
  return Json{{"agv_id", sample.agv_id().to_string()},
              {"by", to_json(sample.by())},
              {"model", enumerator_name(kModels, sample.model())},
              {"footprint", enumerator_name(kFootprints, sample.footprint())},
              {"radius_m", sample.radius_m()},
              {"length_m", sample.length_m()},
              {"width_m", sample.width_m()},
              {"ahead_m", sample.ahead_m()},
              {"max_speed_mps", sample.max_speed_mps()},
              {"max_reverse_mps", sample.max_reverse_mps()},
              {"max_turn_radps", sample.max_turn_radps()},
              {"max_acceleration_mps2", sample.max_acceleration_mps2()},
              {"max_deceleration_mps2", sample.max_deceleration_mps2()},
              {"max_turn_acceleration_radps2", sample.max_turn_acceleration_radps2()},
              {"sensor_range_m", sample.sensor_range_m()},
              {"command_timeout_s", sample.command_timeout_s()},
              {"steers_behind", sample.steers_behind()},
              {"wheelbase_m", sample.wheelbase_m()},
              {"max_steering_rad", sample.max_steering_rad()},
              {"max_steering_rate_radps", sample.max_steering_rate_radps()}};
}

Json to_json(const aisle::VehicleState& sample) {
  return Json{{"agv_id", sample.agv_id().to_string()},
              {"by", to_json(sample.by())},
              {"base_in_map", to_json(sample.base_in_map())},
              {"twist", to_json(sample.twist())},
              {"steering_rad", sample.steering_rad()},
              {"hold", name_of(sample.hold())},
              {"command_agv_id", sample.command_agv_id().to_string()},
              {"command_by", to_json(sample.command_by())},
              {"command_plan_id", sample.command_plan_id()},
              {"accepted_epoch", sample.accepted_epoch()},
              {"refused_commands", sample.refused_commands()}};
}

Json to_json(const aisle::Scan& sample) {
  return Json{{"agv_id", sample.agv_id().to_string()},
              {"by", to_json(sample.by())},
              {"base_in_map", to_json(sample.base_in_map())},
              {"position_sigma_m", sample.position_sigma_m()},
              {"yaw_sigma_rad", sample.yaw_sigma_rad()},
              {"twist", to_json(sample.twist())},
              {"first_angle_rad", sample.first_angle_rad()},
              {"angle_step_rad", sample.angle_step_rad()},
              {"sweep_s", sample.sweep_s()},
              {"range_min_m", sample.range_min_m()},
              {"range_max_m", sample.range_max_m()},
              {"ranges_m", sample.ranges_m()}};
}

Json to_json(const aisle::VelocityCommand& sample) {
  return Json{{"agv_id", sample.agv_id().to_string()},   {"by", to_json(sample.by())},
              {"goal_id", sample.goal_id().to_string()}, {"plan_id", sample.plan_id()},
              {"map_revision", sample.map_revision()},   {"twist", to_json(sample.twist())},
              {"scan_stamp_ns", sample.scan_stamp_ns()}, {"control_ms", sample.control_ms()}};
}

Json to_json(const aisle::WorldObstacle& sample) {
  return Json{{"obstacle_id", sample.obstacle_id().to_string()},
              {"by", to_json(sample.by())},
              {"kind", enumerator_name(kBodies, sample.kind())},
              {"shape", enumerator_name(kFootprints, sample.shape())},
              {"base_in_map", to_json(sample.base_in_map())},
              {"velocity_x_mps", sample.velocity_x_mps()},
              {"velocity_y_mps", sample.velocity_y_mps()},
              {"radius_m", sample.radius_m()},
              {"length_m", sample.length_m()},
              {"width_m", sample.width_m()},
              {"ahead_m", sample.ahead_m()}};
}

}  // namespace aisle::wire
