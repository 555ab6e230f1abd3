#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "services/fake-world/core/world.hpp"

namespace aisle::fake_world {

/// False when it could not be written. `run` names the scenario and the seed.
bool keep(const std::filesystem::path& file, const std::string& run, const Memory& memory);

/// None when there is no file, it belongs to another run, or it is not what keep() writes.
std::optional<Memory> recall(const std::filesystem::path& file, const std::string& run);

}  // namespace aisle::fake_world
