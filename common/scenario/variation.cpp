#include "common/scenario/variation.hpp"

namespace aisle::scenario {

/// A hash of the name is mixed with the seed, so that things of one run vary independently of each
/// other.
std::mt19937_64 random_for(std::uint64_t seed, const std::string& name) {
  std::uint64_t hash = 14695981039346656037ull ^ seed;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;

  std::seed_seq spread{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                       static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32)};
  return std::mt19937_64(spread);
}

/// Uniform in a square, and 0.1 rad to either side.
geometry::Pose2 varied_start(const Vehicle& vehicle, double jitter_m, std::uint64_t seed) {
  if (jitter_m <= 0.0) return vehicle.start_in_map;

  std::mt19937_64 random = random_for(seed, vehicle.id);
  std::uniform_real_distribution<double> offset_m(-jitter_m, jitter_m);
  std::uniform_real_distribution<double> offset_rad(-0.1, 0.1);
  geometry::Pose2 start = vehicle.start_in_map;

  start.x += offset_m(random);
  start.y += offset_m(random);
  start.yaw = geometry::wrap(start.yaw + offset_rad(random));

  return start;
}

}  // namespace aisle::scenario
