#pragma once
#include <random>
#include <vector>

#include "services/fake-vehicle/core/parameters.hpp"
#include "services/fake-vehicle/core/surroundings.hpp"

namespace aisle::fake_vehicle {

/// Ranges in metres, counter-clockwise, the first ray straight ahead, all at one moment. A ray that meets nothing
/// within range_max_m reads range_max_m; noise never turns a hit into nothing, nor a reading below range_min_m.
std::vector<float> scan(const Surroundings& around, const geometry::Pose2& base_in_map, const LidarParameters& lidar,
                        std::mt19937_64& random);

}  // namespace aisle::fake_vehicle
