#include "services/fake-vehicle/core/lidar.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/line_of_sight.hpp"

namespace aisle::fake_vehicle {
namespace {

/// Shortens the rays that meet `body`; only those within its angle are tried.
void cast_on(const geometry::Body& body, const geometry::Pose2& base_in_map, double range_max_m,
             std::vector<double>& ranges_m) {
  const geometry::Point2 from = base_in_map.position();
  const double away_m = geometry::distance(from, body.base_in_map.position());
  const double reach_m = geometry::reach_m(body);
  if (away_m - reach_m >= range_max_m) return;

  // Seen from the scanner the body lies within middle +- asin(reach / away); inside of its circle it is all around.
  const int rays = static_cast<int>(ranges_m.size());
  const double step_rad = 2.0 * geometry::kPi / rays;
  const double half_rad = away_m > reach_m ? std::asin(reach_m / away_m) : geometry::kPi;
  const double middle_rad = geometry::bearing(from, body.base_in_map.position()) - base_in_map.yaw;

  const int first = static_cast<int>(std::floor((middle_rad - half_rad) / step_rad));
  const int count = std::min(rays, static_cast<int>(std::ceil(2.0 * half_rad / step_rad)) + 2);

  for (int i = 0; i < count; ++i) {
    const int ray = ((first + i) % rays + rays) % rays;
    double& range = ranges_m[static_cast<std::size_t>(ray)];
    range = std::min(range, geometry::ray_hit_m(body, from, base_in_map.yaw + ray * step_rad, range_max_m));
  }
}

}  // namespace

std::vector<float> scan(const Surroundings& around, const geometry::Pose2& base_in_map, const LidarParameters& lidar,
                        std::mt19937_64& random) {
  const double step_rad = 2.0 * geometry::kPi / lidar.rays;
  std::vector<double> ranges_m(static_cast<std::size_t>(lidar.rays), lidar.range_max_m);

  // Walls first, then each body shortens the rays that meet it.
  for (int ray = 0; ray < lidar.rays; ++ray) {
    ranges_m[static_cast<std::size_t>(ray)] =
        grid::cast_ray(around.walls, base_in_map.position(), base_in_map.yaw + ray * step_rad, lidar.range_max_m);
  }

  for (const geometry::Body& body : around.bodies) cast_on(body, base_in_map, lidar.range_max_m, ranges_m);

  std::normal_distribution<double> noise_m(0.0, lidar.range_noise_m > 0.0 ? lidar.range_noise_m : 1.0);
  std::vector<float> readings;
  readings.reserve(ranges_m.size());

  // Noise only on hits, and only within what a hit may read.
  const double farthest_hit_m = lidar.range_max_m - 1e-3;
  for (const double range : ranges_m) {
    const bool hit = range < farthest_hit_m;
    const double noisy = hit && lidar.range_noise_m > 0.0 ? range + noise_m(random) : range;
    readings.push_back(
        static_cast<float>(hit ? std::clamp(noisy, lidar.range_min_m, farthest_hit_m) : lidar.range_max_m));
  }

  return readings;
}

}  // namespace aisle::fake_vehicle
