#include "common/wire/vehicle_info.hpp"

#include <utility>

#include "common/wire/geometry.hpp"

namespace aisle::wire {
namespace {

constexpr double kSmallestM = 0.01;
constexpr double kLargestM = 10.0;  // of a radius
constexpr double kQuarterTurnRad = 0.5 * geometry::kPi;

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

geometry::Footprint decode_footprint(const aisle::VehicleInfo& sample, Checks& checks) {
  if (sample.footprint() == FootprintKind::FOOTPRINT_DISC) {
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

}  // namespace

aisle::VehicleInfo encode(const VehicleInfo& vehicle) {
  const geometry::Footprint& footprint = vehicle.footprint;
  const kinematics::Limits& limits = vehicle.limits;
  aisle::VehicleInfo sample;
  sample.agv_id(vehicle.agv_id);
  sample.model(static_cast<KinematicModel>(limits.model));
  sample.footprint(static_cast<FootprintKind>(footprint.shape));
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

Decoded<VehicleInfo> decode(const aisle::VehicleInfo& sample) {
  Checks checks;
  VehicleInfo vehicle;
  vehicle.agv_id = sample.agv_id().to_string();
  checks.id("agv_id", vehicle.agv_id)
      .known("model", sample.model(), KinematicModel::MODEL_TRICYCLE)
      .known("footprint", sample.footprint(), FootprintKind::FOOTPRINT_RECTANGLE)
      .within("sensor_range_m", sample.sensor_range_m(), 0.0, 1000.0)
      .within("command_timeout_s", sample.command_timeout_s(), 0.0, 60.0);
  kinematics::Limits& limits = vehicle.limits;
  limits = {sample.max_speed_mps(),         sample.max_reverse_mps(),       sample.max_turn_radps(),
            sample.max_acceleration_mps2(), sample.max_deceleration_mps2(), sample.max_turn_acceleration_radps2()};
  for (const LimitField& field : kLimits) checks.within(field.name, limits.*field.ours, field.low, field.high);
  vehicle.footprint = decode_footprint(sample, checks);
  if (sample.model() == KinematicModel::MODEL_TRICYCLE) limits.axle = decode_axle(sample, checks);
  vehicle.sensor_range_m = sample.sensor_range_m();
  vehicle.command_timeout_s = sample.command_timeout_s();
  if (!checks.ok()) return Decoded<VehicleInfo>::refused(checks.reason());
  limits.model = static_cast<kinematics::Model>(sample.model());
  return vehicle;
}

}  // namespace aisle::wire
