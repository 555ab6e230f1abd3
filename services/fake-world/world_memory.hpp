#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "services/fake-world/core/world.hpp"

namespace aisle::fake_world {

/// Writes the world's progress to `file`, as JSON, whole or not at all.
/// @param run names the scenario and the seed; recall() finds the file under the same name only
/// @return false when it could not be written
bool keep(const std::filesystem::path& file, const std::string& run, const Memory& memory);

/// Reads what keep() wrote. None when there is no file, when it belongs to another run, and when it is broken.
std::optional<Memory> recall(const std::filesystem::path& file, const std::string& run);

}  // namespace aisle::fake_world
