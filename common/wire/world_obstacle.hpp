#pragma once
// Samples of WorldObstacle (idl/vehicle.idl), the ground truth of a simulation, to and from our own types.
#include <cstdint>
#include <string>

#include "common/geometry/body.hpp"
#include "common/wire/checks.hpp"
#include "idl/vehicle.hpp"

namespace aisle::wire {

struct WorldObstacle {
  enum class Kind { kVehicle, kPerson, kBlock };
  std::string id;
  Kind kind{Kind::kPerson};
  geometry::Body body;
  geometry::Point2 velocity_in_map;   // m/s
  std::uint64_t boot_id{0};           // of the process that simulates it; read only
};

/// `by` is left to the writer.
aisle::WorldObstacle encode(const WorldObstacle& obstacle);
Decoded<WorldObstacle> decode(const aisle::WorldObstacle& sample);

}  // namespace aisle::wire
