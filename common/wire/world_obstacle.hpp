#pragma once
// Samples of WorldObstacle (idl/vehicle.idl), the ground truth of a simulation, to and from our own types.
#include <cstdint>
#include <string>

#include "common/geometry/body.hpp"
#include "common/geometry/footprint.hpp"
#include "common/wire/checks.hpp"
#include "idl/vehicle.hpp"

namespace aisle::wire {

struct WorldObstacle {
  enum class Kind { kVehicle, kPerson, kBlock };
  std::string id;
  Kind kind{Kind::kPerson};
  geometry::Pose2 base_in_map;       // of the thing's frame
  geometry::Footprint footprint;     // around it
  geometry::Point2 velocity_in_map;  // m/s
  std::uint64_t boot_id{0};          // of the process that simulates it; read only

  geometry::Body body() const { return geometry::body_of(footprint, base_in_map); }
};

/// `by` is left to the writer.
aisle::WorldObstacle encode(const WorldObstacle& obstacle);
Decoded<WorldObstacle> decode(const aisle::WorldObstacle& sample);

}  // namespace aisle::wire
