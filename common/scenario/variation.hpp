#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "common/scenario/scenario.hpp"

namespace aisle::scenario {

/// A random generator for one thing of one run: the same sequence for the same seed and name, in every
/// process.
std::mt19937_64 random_for(std::uint64_t seed, const std::string& name);

/// Where the vehicle starts in the run with this seed: within `jitter_m` of its start along x and y, and 0.1 rad of its
/// heading. Without jitter: exactly there.
geometry::Pose2 varied_start(const Vehicle& vehicle, double jitter_m, std::uint64_t seed);

}  // namespace aisle::scenario
