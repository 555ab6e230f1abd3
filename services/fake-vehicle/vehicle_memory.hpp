#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/geometry/pose.hpp"

namespace aisle::fake_vehicle {

/// What the state file keeps, so that the body stays where it was after the process was killed, and a source of
/// commands that was replaced stays refused.
struct VehicleMemory {
  std::string run;  // names the vehicle and its run; recall() ignores the memory of another
  geometry::Pose2 base_in_map;
  std::uint32_t accepted_epoch{0};
};

/// Writes the state file, JSON in one line, whole or not at all. False when it could not be written.
bool keep(const std::filesystem::path& file, const VehicleMemory& memory);

/// Reads what keep() wrote. None when there is no file, when it belongs to another run, and when it is broken.
std::optional<VehicleMemory> recall(const std::filesystem::path& file, const std::string& run);

}  // namespace aisle::fake_vehicle
