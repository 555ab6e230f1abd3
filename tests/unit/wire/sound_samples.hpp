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

}  // namespace aisle::wire
