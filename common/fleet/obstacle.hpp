#pragma once

#include <string>

#include "common/geometry/footprint.hpp"

namespace aisle::fleet {

/// Ground truth of a simulation: a thing that stands or moves on the floor, vehicles included.
/// Simulated sensors and the referee use it; planners never do.
struct Obstacle {
  enum class Kind { kVehicle, kPerson, kBlock };

  std::string id;
  Kind kind{Kind::kPerson};
  geometry::Pose2 base_in_map;       // of the thing's frame
  geometry::Footprint footprint;     // around it, each length 0 to 1000
  geometry::Point2 velocity_in_map;  // m/s, each component within 100

  /// Its outline in map.
  geometry::Body body() const { return geometry::body_of(footprint, base_in_map); }
};

}  // namespace aisle::fleet
