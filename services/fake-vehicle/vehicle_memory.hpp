#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/geometry/pose.hpp"

namespace aisle::fake_vehicle {

/// What survives a kill -9: the body stays where it was, and who was replaced stays refused.
struct VehicleMemory {
  std::string run;  // which vehicle of which run this is; of another one, the memory does not count
  geometry::Pose2 base_in_map;
  std::uint32_t accepted_epoch{0};
};

/// False when it could not be written.
bool keep(const std::filesystem::path& file, const VehicleMemory& memory);

/// None when there is no file, it belongs to another run, or it is not what keep() writes.
std::optional<VehicleMemory> recall(const std::filesystem::path& file, const std::string& run);

}  // namespace aisle::fake_vehicle
