#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/sim/setup.hpp"

namespace aisle::sim {

/// Names of the scenario families, each a kind of difficulty.
std::vector<std::string> families();

/// One of them, varied by seed. @throws config::BadInput for an unknown name
Setup make_setup(const std::string& family, std::uint64_t seed);

/// A scenario file with its map and recordings. @throws config::BadInput, also where a vehicle starts in a wall or in
/// another vehicle
Setup read_setup(const std::filesystem::path& scenario_file, std::uint64_t seed);

/// A family by its name, else a scenario file by its path. @throws config::BadInput, with the nearest name where it is
/// neither
Setup named_setup(const std::string& name_or_file, std::uint64_t seed);

}  // namespace aisle::sim
