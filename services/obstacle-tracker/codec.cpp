#include "services/obstacle-tracker/codec.hpp"

#include <utility>

#include "common/wire/geometry.hpp"
#include "common/wire/vehicle.hpp"

namespace aisle::obstacle_tracker {
namespace {

using wire::Checks;
using wire::Decoded;

template <class T>
Decoded<T> checked(const Checks& checks, T value) {
  return checks.ok() ? Decoded<T>(std::move(value)) : Decoded<T>::refused(checks.reason());
}

}  // namespace

Decoded<KnownVehicle> decode(const aisle::VehicleInfo& sample) {
  const auto info = wire::decode(sample);
  if (!info) return Decoded<KnownVehicle>::refused(info.reason());
  const geometry::Footprint& footprint = info->footprint;
  KnownVehicle vehicle;
  vehicle.agv_id = info->id;
  vehicle.is_rectangle = !footprint.is_disc();
  vehicle.radius_m = geometry::reach_m(footprint);
  vehicle.length_m = footprint.length_m;
  vehicle.width_m = footprint.width_m;
  vehicle.ahead_m = footprint.ahead_m;
  return vehicle;
}

Decoded<Motion> decode(const aisle::VehicleState& sample) {
  Checks checks;
  checks.id("agv_id", sample.agv_id().to_string());
  Motion motion;
  motion.base_in_map = wire::decode(sample.base_in_map(), checks, "base_in_map");
  motion.twist = wire::decode(sample.twist(), checks, "twist");
  return checked(checks, motion);
}

Decoded<Scan> decode(const aisle::Scan& sample) {
  Checks checks;
  Scan scan;
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
  scan.ranges_m.assign(sample.ranges_m().begin(), sample.ranges_m().end());
  checks.id("agv_id", scan.agv_id);
  return checked(checks, std::move(scan));
}

aisle::Track encode(const Track& track) {
  aisle::Track sample;
  sample.track_id(track.id);
  sample.position_in_map(wire::encode(track.position_in_map));
  sample.velocity_x_mps(track.velocity_in_map.x);
  sample.velocity_y_mps(track.velocity_in_map.y);
  sample.covariance(track.covariance);
  sample.radius_m(track.radius_m);
  sample.age_s(track.age_s);
  sample.unseen_s(track.unseen_s);
  sample.is_static(track.is_static);
  return sample;
}

aisle::Coverage encode(const CoverageTile& tile) {
  aisle::Coverage sample;
  sample.tile_x(tile.tile_x);
  sample.tile_y(tile.tile_y);
  sample.low_in_map(wire::encode(tile.low_in_map));
  sample.cell_m(tile.cell_m);
  sample.width_cells(static_cast<std::uint32_t>(tile.width_cells));
  sample.height_cells(static_cast<std::uint32_t>(tile.height_cells));
  sample.age_step_s(kAgeStep_s);
  sample.ages(tile.ages);
  return sample;
}

}  // namespace aisle::obstacle_tracker
