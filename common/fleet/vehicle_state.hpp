#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/fleet/origin.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// Where a vehicle is and how it moves.
struct Motion {
  geometry::Pose2 base_in_map;  // of the vehicle's frame
  geometry::Twist2 twist;       // in the vehicle's frame
  double steering_rad{0.0};     // of a tricycle's wheel, counter-clockwise from straight, [-pi, pi]; of others 0
};

/// Why a vehicle does not follow commands. kDuplicateId: another process is this vehicle; kPerson: a person holds it.
enum class Hold { kNone, kNoCommand, kLateCommand, kContact, kDuplicateId, kPerson };

/// The velocity command that a vehicle follows, as it took it.
struct CommandInForce {
  std::string agv_id;  // that the command was addressed to
  Origin by;
  std::uint64_t plan_id{0};
};

/// What a vehicle says of itself, 50 times a second.
struct VehicleState {
  std::string agv_id;
  Motion motion;  // as the vehicle believes it, with the error of its localisation
  Hold hold{Hold::kNoCommand};
  std::optional<CommandInForce> command;  // none before the first
  std::uint32_t accepted_epoch{0};        // of velocity commands; a newcomer continues with the next
  std::uint64_t refused_commands{0};      // since the vehicle started
};

/// "late_command"
const char* name(Hold hold);

}  // namespace aisle::fleet
