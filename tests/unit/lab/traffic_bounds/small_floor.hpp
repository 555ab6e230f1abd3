#pragma once

#include "tests/support/places.hpp"
#include "tools/lab/traffic_bounds/fleet_case.hpp"

namespace aisle::lab {

/// Two rooms and a lane between them in which two vehicles cannot pass.
inline Floor small_floor() {
  Floor floor;
  floor.name = "rooms";
  floor.map_file = test_support::source_folder() / "tests/data/traffic/lane.txt";
  floor.map_options = {0.5, 10};
  return floor;
}

}  // namespace aisle::lab
