#include "common/wire/vehicle.hpp"

#include <cmath>
#include <utility>

#include "common/wire/geometry.hpp"
#include "common/wire/origin.hpp"

namespace aisle::wire {
namespace {

constexpr double kSmallestM = 0.01;
constexpr double kLargestM = 10.0;  // of a vehicle's radius
constexpr double kLargestThingM = 1000.0;
constexpr std::size_t kMostRays = 1440;
constexpr double kQuarterTurnRad = 0.5 * geometry::kPi;

/// Enumerators: see planning.cpp.
aisle::KinematicModel to_wire(kinematics::Model model) {
  switch (model) {
    case kinematics::Model::kDifferential:
      return KinematicModel::MODEL_DIFFERENTIAL;
    case kinematics::Model::kOmnidirectional:
      return KinematicModel::MODEL_OMNIDIRECTIONAL;
    case kinematics::Model::kTricycle:
      return KinematicModel::MODEL_TRICYCLE;
  }

  return {};
}

std::optional<kinematics::Model> from_wire(aisle::KinematicModel model) {
  switch (model) {
    case KinematicModel::MODEL_DIFFERENTIAL:
      return kinematics::Model::kDifferential;
    case KinematicModel::MODEL_OMNIDIRECTIONAL:
      return kinematics::Model::kOmnidirectional;
    case KinematicModel::MODEL_TRICYCLE:
      return kinematics::Model::kTricycle;
  }

  return std::nullopt;
}

aisle::FootprintKind to_wire(geometry::Body::Shape shape) {
  switch (shape) {
    case geometry::Body::Shape::kDisc:
      return FootprintKind::FOOTPRINT_DISC;
    case geometry::Body::Shape::kRectangle:
      return FootprintKind::FOOTPRINT_RECTANGLE;
  }

  return {};
}

std::optional<geometry::Body::Shape> from_wire(aisle::FootprintKind shape) {
  switch (shape) {
    case FootprintKind::FOOTPRINT_DISC:
      return geometry::Body::Shape::kDisc;
    case FootprintKind::FOOTPRINT_RECTANGLE:
      return geometry::Body::Shape::kRectangle;
  }

  return std::nullopt;
}

aisle::HoldReason to_wire(fleet::Hold hold) {
  switch (hold) {
    case fleet::Hold::kNone:
      return HoldReason::HOLD_NONE;
    case fleet::Hold::kNoCommand:
      return HoldReason::HOLD_NO_COMMAND;
    case fleet::Hold::kLateCommand:
      return HoldReason::HOLD_LATE_COMMAND;
    case fleet::Hold::kContact:
      return HoldReason::HOLD_CONTACT;
    case fleet::Hold::kDuplicateId:
      return HoldReason::HOLD_DUPLICATE_ID;
    case fleet::Hold::kPerson:
      return HoldReason::HOLD_PERSON;
  }

  return {};
}

std::optional<fleet::Hold> from_wire(aisle::HoldReason hold) {
  switch (hold) {
    case HoldReason::HOLD_NONE:
      return fleet::Hold::kNone;
    case HoldReason::HOLD_NO_COMMAND:
      return fleet::Hold::kNoCommand;
    case HoldReason::HOLD_LATE_COMMAND:
      return fleet::Hold::kLateCommand;
    case HoldReason::HOLD_CONTACT:
      return fleet::Hold::kContact;
    case HoldReason::HOLD_DUPLICATE_ID:
      return fleet::Hold::kDuplicateId;
    case HoldReason::HOLD_PERSON:
      return fleet::Hold::kPerson;
  }

  return std::nullopt;
}

aisle::BodyKind to_wire(fleet::Obstacle::Kind kind) {
  switch (kind) {
    case fleet::Obstacle::Kind::kVehicle:
      return BodyKind::BODY_VEHICLE;
    case fleet::Obstacle::Kind::kPerson:
      return BodyKind::BODY_PERSON;
    case fleet::Obstacle::Kind::kBlock:
      return BodyKind::BODY_BLOCK;
  }

  return {};
}

std::optional<fleet::Obstacle::Kind> from_wire(aisle::BodyKind kind) {
  switch (kind) {
    case BodyKind::BODY_VEHICLE:
      return fleet::Obstacle::Kind::kVehicle;
    case BodyKind::BODY_PERSON:
      return fleet::Obstacle::Kind::kPerson;
    case BodyKind::BODY_BLOCK:
      return fleet::Obstacle::Kind::kBlock;
  }

  return std::nullopt;
}

/// Names of the IDL and of kinematics::Limits, side by side.
struct LimitField {
  const char* name;
  double kinematics::Limits::*ours;
  double low;
  double high;
};

constexpr LimitField kLimits[]{
    {"max_speed_mps", &kinematics::Limits::max_speed_mps, 0.01, kFastestMps},
    {"max_reverse_mps", &kinematics::Limits::max_reverse_mps, 0.0, kFastestMps},
    {"max_turn_radps", &kinematics::Limits::max_turn_radps, 0.01, kFastestTurnRadps},
    {"max_acceleration_mps2", &kinematics::Limits::max_acceleration_mps2, 0.01, 100.0},
    {"max_deceleration_mps2", &kinematics::Limits::max_deceleration_mps2, 0.01, 100.0},
    {"max_turn_acceleration_radps2", &kinematics::Limits::max_turn_acceleration_radps2, 0.01, 1000.0},
};

/// Only the lengths of its own shape are looked at.
geometry::Footprint decode_footprint(const aisle::VehicleInfo& sample, Checks& checks) {
  if (checks.known("footprint", sample.footprint(), from_wire(sample.footprint())) == geometry::Body::Shape::kDisc) {
    checks.within("radius_m", sample.radius_m(), kSmallestM, kLargestM);
    return geometry::disc(sample.radius_m());
  }

  checks.within("length_m", sample.length_m(), kSmallestM, 2.0 * kLargestM)
      .within("width_m", sample.width_m(), kSmallestM, 2.0 * kLargestM)
      .within("ahead_m", sample.ahead_m(), -kLargestM, kLargestM);

  return geometry::rectangle(sample.length_m(), sample.width_m(), sample.ahead_m());
}

kinematics::SteeredAxle decode_axle(const aisle::VehicleInfo& sample, Checks& checks) {
  checks.within("wheelbase_m", sample.wheelbase_m(), 0.05, 2.0 * kLargestM)
      .within("max_steering_rad", sample.max_steering_rad(), 0.01, kQuarterTurnRad - 0.01)
      .within("max_steering_rate_radps", sample.max_steering_rate_radps(), 0.01, kFastestTurnRadps);
  return {sample.wheelbase_m(), sample.max_steering_rad(), sample.max_steering_rate_radps(), sample.steers_behind()};
}

/// None before the first command, and none when it names no vehicle or no source: where the vehicle is counts all the
/// same.
std::optional<fleet::CommandInForce> decode_command(const aisle::VehicleState& sample) {
  Checks checks;
  fleet::CommandInForce command{sample.command_agv_id().to_string(), decode(sample.command_by(), checks, "command_by"),
                                sample.command_plan_id()};

  checks.id("command_agv_id", command.agv_id);
  return checks.ok() ? std::optional(std::move(command)) : std::nullopt;
}

}  // namespace

/// A disc fills length and width with its diameter, for readers that know rectangles only.
aisle::VehicleInfo encode(const fleet::Vehicle& vehicle) {
  const geometry::Footprint& footprint = vehicle.footprint;
  const kinematics::Limits& limits = vehicle.limits;
  aisle::VehicleInfo sample;

  sample.agv_id(vehicle.id);

  sample.model(to_wire(limits.model));
  sample.footprint(to_wire(footprint.shape));

  sample.radius_m(geometry::reach_m(footprint));
  sample.length_m(footprint.is_disc() ? 2.0 * footprint.radius_m : footprint.length_m);
  sample.width_m(footprint.is_disc() ? 2.0 * footprint.radius_m : footprint.width_m);
  sample.ahead_m(footprint.is_disc() ? 0.0 : footprint.ahead_m);

  sample.max_speed_mps(limits.max_speed_mps);
  sample.max_reverse_mps(limits.max_reverse_mps);
  sample.max_turn_radps(limits.max_turn_radps);
  sample.max_acceleration_mps2(limits.max_acceleration_mps2);
  sample.max_deceleration_mps2(limits.max_deceleration_mps2);
  sample.max_turn_acceleration_radps2(limits.max_turn_acceleration_radps2);

  sample.sensor_range_m(vehicle.sensor_range_m);
  sample.command_timeout_s(vehicle.command_timeout_s);

  if (limits.model != kinematics::Model::kTricycle) return sample;

  sample.steers_behind(limits.axle.is_rear);
  sample.wheelbase_m(limits.axle.wheelbase_m);
  sample.max_steering_rad(limits.axle.max_steering_rad);
  sample.max_steering_rate_radps(limits.axle.max_steering_rate_radps);

  return sample;
}

Decoded<fleet::Vehicle> decode(const aisle::VehicleInfo& sample) {
  Checks checks;
  fleet::Vehicle vehicle;

  vehicle.id = sample.agv_id().to_string();
  vehicle.sensor_range_m = sample.sensor_range_m();
  vehicle.command_timeout_s = sample.command_timeout_s();

  checks.id("agv_id", vehicle.id)
      .within("sensor_range_m", vehicle.sensor_range_m, 0.0, 1000.0)
      .within("command_timeout_s", vehicle.command_timeout_s, 0.0, 60.0);

  kinematics::Limits& limits = vehicle.limits;
  limits = {sample.max_speed_mps(),         sample.max_reverse_mps(),       sample.max_turn_radps(),
            sample.max_acceleration_mps2(), sample.max_deceleration_mps2(), sample.max_turn_acceleration_radps2()};
  for (const LimitField& field : kLimits) checks.within(field.name, limits.*field.ours, field.low, field.high);

  limits.model = checks.known("model", sample.model(), from_wire(sample.model()));
  if (limits.model == kinematics::Model::kTricycle) limits.axle = decode_axle(sample, checks);

  vehicle.footprint = decode_footprint(sample, checks);
  return checks.decoded(std::move(vehicle));
}

aisle::VehicleState encode(const fleet::VehicleState& state) {
  aisle::VehicleState sample;
  sample.agv_id(state.agv_id);

  sample.base_in_map(encode(state.motion.base_in_map));
  sample.twist(encode(state.motion.twist));
  sample.steering_rad(state.motion.steering_rad);

  sample.hold(to_wire(state.hold));

  if (state.command) {
    sample.command_agv_id(state.command->agv_id);
    sample.command_by(encode(state.command->by));
    sample.command_plan_id(state.command->plan_id);
  }

  sample.accepted_epoch(state.accepted_epoch);
  sample.refused_commands(state.refused_commands);

  return sample;
}

Decoded<fleet::VehicleState> decode(const aisle::VehicleState& sample) {
  Checks checks;
  fleet::VehicleState state;

  state.agv_id = sample.agv_id().to_string();

  state.motion = {decode(sample.base_in_map(), checks, "base_in_map"), decode(sample.twist(), checks, "twist"),
                  sample.steering_rad()};
  state.hold = checks.known("hold", sample.hold(), from_wire(sample.hold()));

  state.accepted_epoch = sample.accepted_epoch();
  state.refused_commands = sample.refused_commands();
  state.command = decode_command(sample);

  checks.id("agv_id", state.agv_id).within("steering_rad", sample.steering_rad(), -geometry::kPi, geometry::kPi);

  return checks.decoded(std::move(state));
}

aisle::Scan encode(const fleet::Scan& scan) {
  aisle::Scan sample;
  sample.agv_id(scan.agv_id);

  sample.base_in_map(encode(scan.base_in_map));

  sample.position_sigma_m(scan.position_sigma_m);
  sample.yaw_sigma_rad(scan.yaw_sigma_rad);
  sample.twist(encode(scan.twist));

  sample.first_angle_rad(scan.first_angle_rad);
  sample.angle_step_rad(scan.angle_step_rad);
  sample.sweep_s(scan.sweep_s);

  sample.range_min_m(scan.range_min_m);
  sample.range_max_m(scan.range_max_m);
  sample.ranges_m(scan.ranges_m);

  return sample;
}

/// Poses and ranges are copied as they came: the tracker judges them.
Decoded<fleet::Scan> decode(const aisle::Scan& sample) {
  Checks checks;
  fleet::Scan scan;

  scan.agv_id = sample.agv_id().to_string();

  scan.base_in_map = {sample.base_in_map().x_m(), sample.base_in_map().y_m(), sample.base_in_map().yaw_rad()};
  scan.position_sigma_m = sample.position_sigma_m();
  scan.yaw_sigma_rad = sample.yaw_sigma_rad();
  scan.twist = {sample.twist().linear_mps(), sample.twist().angular_radps(), sample.twist().sideways_mps()};

  scan.first_angle_rad = sample.first_angle_rad();
  scan.angle_step_rad = sample.angle_step_rad();
  scan.sweep_s = sample.sweep_s();

  scan.range_min_m = sample.range_min_m();
  scan.range_max_m = sample.range_max_m();

  checks.id("agv_id", scan.agv_id).count("ranges_m", sample.ranges_m().size(), 0, kMostRays);
  if (checks.ok()) scan.ranges_m.assign(sample.ranges_m().begin(), sample.ranges_m().end());

  return checks.decoded(std::move(scan));
}

aisle::VelocityCommand encode(const fleet::VelocityCommand& command) {
  aisle::VelocityCommand sample;
  sample.agv_id(command.agv_id);
  sample.goal_id(command.goal_id);
  sample.plan_id(command.plan_id);
  sample.map_revision(command.map_revision);

  sample.twist(encode(command.twist));
  sample.scan_stamp_ns(command.scan_stamp_ns);
  sample.control_ms(command.control_ms);

  return sample;
}

Decoded<fleet::VelocityCommand> decode(const aisle::VelocityCommand& sample) {
  Checks checks;
  fleet::VelocityCommand command;

  command.agv_id = sample.agv_id().to_string();
  command.goal_id = sample.goal_id().to_string();
  command.plan_id = sample.plan_id();
  command.map_revision = sample.map_revision();

  command.twist = decode(sample.twist(), checks, "twist");
  command.scan_stamp_ns = sample.scan_stamp_ns();
  if (std::isfinite(sample.control_ms())) command.control_ms = sample.control_ms();  // for people: refuses nothing

  checks.id("agv_id", command.agv_id).optional_id("goal_id", command.goal_id);

  return checks.decoded(std::move(command));
}

aisle::WorldObstacle encode(const fleet::Obstacle& obstacle) {
  aisle::WorldObstacle sample;
  sample.obstacle_id(obstacle.id);
  sample.kind(to_wire(obstacle.kind));
  sample.shape(to_wire(obstacle.footprint.shape));

  sample.base_in_map(encode(obstacle.base_in_map));
  sample.velocity_x_mps(obstacle.velocity_in_map.x);
  sample.velocity_y_mps(obstacle.velocity_in_map.y);

  sample.radius_m(obstacle.footprint.radius_m);
  sample.length_m(obstacle.footprint.length_m);
  sample.width_m(obstacle.footprint.width_m);
  sample.ahead_m(obstacle.footprint.ahead_m);

  return sample;
}

Decoded<fleet::Obstacle> decode(const aisle::WorldObstacle& sample) {
  Checks checks;
  fleet::Obstacle obstacle;

  obstacle.id = sample.obstacle_id().to_string();
  obstacle.kind = checks.known("kind", sample.kind(), from_wire(sample.kind()));

  obstacle.footprint.shape = checks.known("shape", sample.shape(), from_wire(sample.shape()));
  obstacle.footprint.radius_m = sample.radius_m();
  obstacle.footprint.length_m = sample.length_m();
  obstacle.footprint.width_m = sample.width_m();
  obstacle.footprint.ahead_m = sample.ahead_m();

  obstacle.velocity_in_map = {sample.velocity_x_mps(), sample.velocity_y_mps()};
  obstacle.base_in_map = decode(sample.base_in_map(), checks, "base_in_map");

  checks.id("obstacle_id", obstacle.id)
      .within("radius_m", sample.radius_m(), 0.0, kLargestThingM)
      .within("length_m", sample.length_m(), 0.0, kLargestThingM)
      .within("width_m", sample.width_m(), 0.0, kLargestThingM)
      .within("ahead_m", sample.ahead_m(), -kLargestThingM, kLargestThingM)
      .within("velocity_x_mps", sample.velocity_x_mps(), -kFastestMps, kFastestMps)
      .within("velocity_y_mps", sample.velocity_y_mps(), -kFastestMps, kFastestMps);

  return checks.decoded(std::move(obstacle));
}

}  // namespace aisle::wire
