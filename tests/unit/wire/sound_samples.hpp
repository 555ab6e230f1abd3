#pragma once
// A sample of each type that its decoder accepts.
#include "common/geometry/footprint.hpp"
#include "common/grid/tiles.hpp"
#include "tests/unit/bus/golden_samples.hpp"

namespace aisle::wire {

/// The sample that tests/data/cdr holds; hashes and lengths, which the golden samples make up, as a decoder wants them.
template <class Sample>
Sample sound_sample() {
  Sample sample;
  bus_test::fill(sample);
  return sample;
}
template <>
inline aisle::MapInfo sound_sample() {
  aisle::MapInfo sample;
  bus_test::fill(sample);
  sample.tile_hashes().resize(13 * 8, 7);
  sample.hash(grid::map_hash(sample.tile_hashes()));
  return sample;
}
template <>
inline aisle::MapTile sound_sample() {
  aisle::MapTile sample;
  bus_test::fill(sample);
  using grid::Occupancy;
  sample.hash(grid::tile_hash(
      {Occupancy::kFree, Occupancy::kOccupied, Occupancy::kUnknown, Occupancy::kOccupied, Occupancy::kFree}));
  return sample;
}
template <>
inline aisle::VehicleInfo sound_sample() {
  aisle::VehicleInfo sample;
  bus_test::fill(sample);
  sample.radius_m(geometry::reach_m(geometry::rectangle(sample.length_m(), sample.width_m(), sample.ahead_m())));
  return sample;
}

}  // namespace aisle::wire
