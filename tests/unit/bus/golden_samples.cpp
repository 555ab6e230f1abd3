#include "tests/unit/bus/golden_samples.hpp"

namespace aisle::bus_test {
namespace {

Origin origin() {
  Origin by;
  by.source_id("planner-1");
  by.boot_id(0x1122334455667788U);
  by.epoch(3);
  by.sequence_number(4711);
  by.stamp_ns(1700000000123456789);
  return by;
}

Point point(double x, double y) {
  Point p;
  p.x_m(x);
  p.y_m(y);
  return p;
}

Pose pose(double x, double y, double yaw) {
  Pose p;
  p.x_m(x);
  p.y_m(y);
  p.yaw_rad(yaw);
  return p;
}

Twist twist(double linear, double angular) {
  Twist t;
  t.linear_mps(linear);
  t.angular_radps(angular);
  t.sideways_mps(0.0625);
  return t;
}

}  // namespace

void fill(MapInfo& sample) {
  sample.map_id("warehouse");
  sample.by(origin());
  sample.revision(12);
  sample.width_cells(800);
  sample.height_cells(500);
  sample.resolution_m(0.05);
  sample.origin_in_map(pose(-1.5, 2.25, 0.0));
  sample.tile_size_cells(64);
  sample.hash(0xcbf29ce484222325U);
  sample.tile_hashes({1, 2, 0xffffffffffffffffU});
}

void fill(MapTile& sample) {
  sample.map_id("warehouse");
  sample.tile_x(3);
  sample.tile_y(4);
  sample.revision(12);
  sample.hash(99);
  sample.cells({0, 1, 2, 1, 0});
}

void fill(MapRequest& sample) {
  sample.requester_id("local-planner-agv-1");
  sample.map_id("warehouse");
  sample.sequence_number(5);
  sample.tiles({7, 8, 9});
}

void fill(MapEdit& sample) {
  sample.edit_id("edit-1");
  sample.by(origin());
  sample.map_id("warehouse");
  sample.action(EditAction::EDIT_UNBLOCK);
  sample.shape(EditShape::SHAPE_DISC);
  sample.points({point(1.0, 2.0), point(3.0, 4.0)});
  sample.radius_m(0.75);
}

void fill(MapEditResult& sample) {
  sample.edit_id("edit-1");
  sample.by(origin());
  sample.map_id("warehouse");
  sample.outcome(EditOutcome::EDIT_REFUSED);
  sample.detail("outside the map");
  sample.revision(12);
  sample.changed_cells(0);
}

void fill(VehicleInfo& sample) {
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.model(KinematicModel::MODEL_TRICYCLE);
  sample.footprint(FootprintKind::FOOTPRINT_RECTANGLE);
  sample.radius_m(0.5);
  sample.length_m(0.8);
  sample.width_m(0.6);
  sample.ahead_m(0.15);
  sample.max_speed_mps(1.2);
  sample.max_reverse_mps(0.3);
  sample.max_turn_radps(1.1);
  sample.max_acceleration_mps2(0.8);
  sample.max_deceleration_mps2(1.3);
  sample.max_turn_acceleration_radps2(2.5);
  sample.sensor_range_m(12.0);
  sample.command_timeout_s(0.2);
  sample.steers_behind(true);
  sample.wheelbase_m(1.5);
  sample.max_steering_rad(1.2);
  sample.max_steering_rate_radps(0.8);
}

void fill(VehicleState& sample) {
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.base_in_map(pose(1.0, 2.0, -0.5));
  sample.twist(twist(0.9, -0.1));
  sample.steering_rad(-0.375);
  sample.hold(HoldReason::HOLD_LATE_COMMAND);
  sample.command_agv_id("agv-1");
  sample.command_by(origin());
  sample.command_plan_id(77);
  sample.accepted_epoch(3);
  sample.refused_commands(2);
}

void fill(Scan& sample) {
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.base_in_map(pose(1.0, 2.0, -0.5));
  sample.position_sigma_m(0.02);
  sample.yaw_sigma_rad(0.009);
  sample.twist(twist(0.9, -0.1));
  sample.first_angle_rad(-3.0);
  sample.angle_step_rad(0.0175);
  sample.sweep_s(0.05);
  sample.range_min_m(0.1);
  sample.range_max_m(12.0);
  sample.ranges_m({1.5F, 2.5F, 12.0F});
}

void fill(Goal& sample) {
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.goal_id("goal-9");
  sample.pose_in_map(pose(10.0, 20.0, 1.5));
  sample.position_tolerance_m(0.1);
  sample.yaw_tolerance_rad(0.2);
  sample.cancelled(true);
}

void fill(Plan& sample) {
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.plan_id(77);
  sample.goal_id("goal-9");
  sample.map_id("warehouse");
  sample.map_revision(12);
  sample.outcome(PlanOutcome::PLAN_GOAL_BLOCKED);
  sample.trigger(PlanTrigger::TRIGGER_TRACK);
  sample.detail("goal in a rack");
  sample.planner("wang");
  sample.goal_in_map(pose(10.0, 20.0, 1.5));
  sample.position_tolerance_m(0.1);
  sample.yaw_tolerance_rad(0.2);
  sample.waypoints_in_map({point(1.0, 2.0), point(10.0, 20.0)});
  sample.length_m(20.1);
  sample.planning_ms(3.5);
}

void fill(Track& sample) {
  sample.track_id(4);
  sample.by(origin());
  sample.scan_stamp_ns(1700000000100000000);
  sample.position_in_map(point(5.0, 6.0));
  sample.velocity_x_mps(0.5);
  sample.velocity_y_mps(-0.25);
  for (std::size_t i = 0; i < 16; ++i) sample.covariance()[i] = 0.125 * static_cast<double>(i);
  sample.radius_m(0.3);
  sample.age_s(2.0);
  sample.unseen_s(0.1);
  sample.is_static(true);
}

void fill(TrackingStatus& sample) {
  ScanUse use;
  use.agv_id("agv-1");
  use.scan_sequence(55);
  use.scan_stamp_ns(1700000000100000000);
  sample.source_id("obstacle-tracker");
  sample.by(origin());
  sample.newest_scans({use});
  sample.live_track_ids({4, 5});
  sample.scans_used(1000);
  sample.scans_dropped(1);
  sample.processing_ms(0.4);
}

void fill(Coverage& sample) {
  sample.source_id("obstacle-tracker");
  sample.tile_x(1);
  sample.tile_y(2);
  sample.by(origin());
  sample.map_id("warehouse");
  sample.low_in_map(point(32.0, 64.0));
  sample.cell_m(0.5);
  sample.width_cells(2);
  sample.height_cells(3);
  sample.age_step_s(0.25);
  sample.ages({0, 1, 2, 253, 254, 255});
}

void fill(VelocityCommand& sample) {
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.goal_id("goal-9");
  sample.plan_id(77);
  sample.map_revision(12);
  sample.twist(twist(0.7, 0.3));
  sample.scan_stamp_ns(1700000000100000000);
  sample.control_ms(1.25);
}

void fill(NavigationStatus& sample) {
  IntentPoint soon;
  soon.offset_s(0.5);
  soon.base_in_map(pose(1.1, 2.1, -0.4));
  sample.agv_id("agv-1");
  sample.by(origin());
  sample.goal_id("goal-9");
  sample.plan_id(77);
  sample.map_revision(12);
  sample.phase(NavigationPhase::PHASE_BLOCKED);
  sample.reason(NavigationReason::REASON_OBSTACLE);
  sample.detail("a person");
  sample.distance_left_m(8.0);
  sample.time_left_s(9.5);
  sample.blocked_at_in_map(point(3.0, 4.0));
  sample.blocked_radius_m(0.3);
  sample.control_ms(1.25);
  sample.intent({soon});
}

void fill(WorldObstacle& sample) {
  sample.obstacle_id("person-1");
  sample.by(origin());
  sample.kind(BodyKind::BODY_BLOCK);
  sample.shape(FootprintKind::FOOTPRINT_RECTANGLE);
  sample.base_in_map(pose(5.0, 6.0, 0.25));
  sample.velocity_x_mps(1.0);
  sample.velocity_y_mps(-1.0);
  sample.radius_m(0.3);
  sample.length_m(0.6);
  sample.width_m(0.4);
  sample.ahead_m(0.1);
}

void fill(ServiceHealth& sample) {
  Counter counter;
  counter.name("plans");
  counter.value(17);
  sample.instance_id("global-planner-1");
  sample.by(origin());
  sample.service("global-planner");
  sample.software_version("0.1.0");
  sample.idl_version(1);
  sample.host("host-1");
  sample.process_id(4242);
  sample.agv_id("");
  sample.map_id("warehouse");
  sample.map_revision(12);
  sample.map_hash(0xcbf29ce484222325U);
  sample.state(ServiceState::SERVICE_DEGRADED);
  sample.waits_for("vehicle_state");
  sample.last_error("no path");
  sample.wall_clock_ns(1700000000123456789);
  sample.cpu_percent(12.5);
  sample.resident_mb(18.25);
  sample.counters({counter});
}

}  // namespace aisle::bus_test
