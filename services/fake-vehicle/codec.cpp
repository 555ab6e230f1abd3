#include "services/fake-vehicle/codec.hpp"

#include "common/wire/geometry.hpp"
#include "common/wire/origin.hpp"

namespace aisle::fake_vehicle {
namespace {

HoldReason reason_of(Hold hold) {
  switch (hold) {
    case Hold::kNone:
      return HoldReason::HOLD_NONE;
    case Hold::kNoCommand:
      return HoldReason::HOLD_NO_COMMAND;
    case Hold::kLateCommand:
      return HoldReason::HOLD_LATE_COMMAND;
    case Hold::kContact:
      return HoldReason::HOLD_CONTACT;
  }
  return HoldReason::HOLD_NONE;
}

}  // namespace

aisle::VehicleState encode(const Report& report) {
  aisle::VehicleState sample;
  sample.agv_id(report.agv_id);
  sample.base_in_map(wire::encode(report.base_in_map));
  sample.twist(wire::encode(report.twist));
  sample.steering_rad(report.steering_rad);
  sample.hold(reason_of(report.hold));
  if (report.command) {
    const Command& command = *report.command;
    sample.command_agv_id(command.agv_id);
    sample.command_by(wire::encode(
        fleet::Origin{command.source_id, command.boot_id, command.epoch, command.sequence_number, command.stamp_ns}));
    sample.command_plan_id(command.plan_id);
  }
  sample.accepted_epoch(report.accepted_epoch);
  sample.refused_commands(report.refused_commands);
  return sample;
}

aisle::Scan encode_scan(const Report& report, const Parameters& vehicle, const std::vector<float>& ranges_m) {
  aisle::Scan sample;
  sample.agv_id(report.agv_id);
  sample.base_in_map(wire::encode(report.base_in_map));
  sample.position_sigma_m(vehicle.pose_noise_m);
  sample.yaw_sigma_rad(vehicle.yaw_noise_rad);
  sample.twist(wire::encode(report.twist));
  sample.first_angle_rad(0.0);
  sample.angle_step_rad(2.0 * geometry::kPi / static_cast<double>(ranges_m.size()));
  sample.sweep_s(0.0);
  sample.range_min_m(vehicle.lidar.range_min_m);
  sample.range_max_m(vehicle.lidar.range_max_m);
  sample.ranges_m(ranges_m);
  return sample;
}

Command decode(const aisle::VelocityCommand& sample) {
  Command command;
  command.agv_id = sample.agv_id().to_string();
  command.source_id = sample.by().source_id().to_string();
  command.boot_id = sample.by().boot_id();
  command.epoch = sample.by().epoch();
  command.sequence_number = sample.by().sequence_number();
  command.stamp_ns = sample.by().stamp_ns();
  command.plan_id = sample.plan_id();
  command.twist = {sample.twist().linear_mps(), sample.twist().angular_radps(), sample.twist().sideways_mps()};
  return command;
}

}  // namespace aisle::fake_vehicle
