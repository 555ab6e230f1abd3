#pragma once
// Samples of idl/vehicle.idl to and from the simulated vehicle's own types. Encoders leave `by` to the writer.
#include <optional>
#include <string>
#include <vector>

#include "idl/vehicle.hpp"
#include "services/fake-vehicle/core/command_authority.hpp"
#include "services/fake-vehicle/core/parameters.hpp"
#include "services/fake-vehicle/core/simulated_vehicle.hpp"

namespace aisle::fake_vehicle {

/// What the vehicle says of itself: where it believes to be, and the command in force.
struct Report {
  std::string agv_id;
  geometry::Pose2 base_in_map;
  geometry::Twist2 twist;
  double steering_rad{0.0};  // of a tricycle
  Hold hold{Hold::kNoCommand};
  std::optional<Command> command;
  std::uint32_t accepted_epoch{0};
  std::uint64_t refused_commands{0};
};
aisle::VehicleState encode(const Report& report);

aisle::Scan encode_scan(const Report& report, const Parameters& vehicle, const std::vector<float>& ranges_m);

/// As it came: CommandAuthority looks at every field.
Command decode(const aisle::VelocityCommand& sample);

}  // namespace aisle::fake_vehicle
