#pragma once
// A sample of each type that its decoder accepts.
#include <cstddef>

#include "common/geometry/footprint.hpp"
#include "common/grid/tiles.hpp"
#include "tests/unit/bus/golden_samples.hpp"

namespace aisle::wire {

/// The sample that tests/data/cdr holds; hashes and lengths, which the golden samples make up, as a decoder wants them.
template <class Sample>
Sample sound_sample() {
  return bus_test::golden_sample<Sample>();
}
template <>
inline aisle::MapInfo sound_sample() {
  auto sample = bus_test::golden_sample<aisle::MapInfo>();
  sample.tile_hashes().resize(std::size_t{13} * 8, 7);
  sample.hash(grid::map_hash(sample.tile_hashes()));
  return sample;
}
template <>
inline aisle::MapTile sound_sample() {
  auto sample = bus_test::golden_sample<aisle::MapTile>();
  using grid::Occupancy;
  sample.hash(grid::tile_hash(
      {Occupancy::kFree, Occupancy::kOccupied, Occupancy::kUnknown, Occupancy::kOccupied, Occupancy::kFree}));
  return sample;
}
template <>
inline aisle::VehicleInfo sound_sample() {
  auto sample = bus_test::golden_sample<aisle::VehicleInfo>();
  sample.radius_m(geometry::reach_m(geometry::rectangle(sample.length_m(), sample.width_m(), sample.ahead_m())));
  return sample;
}

/// A disc with a speed.
inline void make_sound(aisle::MapZone& zone) {
  zone.kind(aisle::ZoneKind::ZONE_SPEED);
  zone.shape(aisle::EditShape::SHAPE_DISC);
  zone.points().resize(1);
  zone.direction_rad(0.0);
}
template <>
inline aisle::ZoneEdit sound_sample() {
  auto sample = bus_test::golden_sample<aisle::ZoneEdit>();
  sample.action(aisle::ZoneAction::ZONE_ADD);
  make_sound(sample.zone());
  return sample;
}
template <>
inline aisle::MapZones sound_sample() {
  auto sample = bus_test::golden_sample<aisle::MapZones>();
  for (aisle::MapZone& zone : sample.zones()) make_sound(zone);
  return sample;
}

}  // namespace aisle::wire
