#pragma once

#include <random>
#include <vector>

#include "services/fake-vehicle/core/parameters.hpp"
#include "services/fake-vehicle/core/surroundings.hpp"

namespace aisle::fake_vehicle {

/// One turn of the scanner, all rays at one moment: `lidar.rays` ranges in metres, counter-clockwise from straight
/// ahead. A ray that meets nothing within range_max_m reads range_max_m. Noise is normal, with the standard deviation
/// range_noise_m; it never turns a hit into nothing, nor a reading below range_min_m.
/// @param base_in_map true pose of the vehicle, in whose centre the scanner stands
std::vector<float> scan(const Surroundings& around, const geometry::Pose2& base_in_map, const LidarParameters& lidar,
                        std::mt19937_64& random);

}  // namespace aisle::fake_vehicle
