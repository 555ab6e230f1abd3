#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/lockstep/simulation.hpp"

namespace aisle::lockstep {

/// Names of the scenario families, each a kind of difficulty.
std::vector<std::string> families();
/// One of them, varied by seed. @throws std::invalid_argument for an unknown name
Setup make_setup(const std::string& family, std::uint64_t seed);

/// A scenario file with its map and recordings. @throws config::BadInput
Setup read_setup(const std::filesystem::path& scenario_file, std::uint64_t seed);

}  // namespace aisle::lockstep
