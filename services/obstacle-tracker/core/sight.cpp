#include "services/obstacle-tracker/core/sight.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::obstacle_tracker {

Sight look_for(const Scan& scan, const SortedScan& sorted, geometry::Point2 place_in_map, double radius_m,
               double doubt_m) {
  constexpr double kMargin_m = 0.15;
  const double away_m = geometry::distance(sorted.sensor_in_map, place_in_map);

  // Rays that graze the rim may miss a thing that is there: only the inner half of it must show, or miss, it.
  const double half_width_m = 0.5 * radius_m + doubt_m;

  const double behind_m = away_m + 0.5 * radius_m + doubt_m;
  const double before_m = away_m - radius_m - doubt_m - kMargin_m;

  if (behind_m > scan.range_max_m || before_m < scan.range_min_m) return Sight::kOutOfView;

  // The rays towards it: the middle one, and so many to each side.
  const int count = static_cast<int>(scan.ranges_m.size());
  const double bearing_rad = geometry::bearing(sorted.sensor_in_map, place_in_map) - sorted.middle_bearing_of_first_rad;
  double turn_rad = std::fmod(bearing_rad, 2.0 * geometry::kPi);
  if (turn_rad < 0.0) turn_rad += 2.0 * geometry::kPi;

  const int middle = static_cast<int>(std::lround(turn_rad / scan.angle_step_rad));
  const int spread = static_cast<int>(std::asin(std::min(1.0, half_width_m / away_m)) / scan.angle_step_rad);
  const bool wraps = is_full_turn(scan);

  // Count where they end.
  int through = 0;
  int touching = 0;
  int hidden = 0;

  for (int k = middle - spread; k <= middle + spread; ++k) {
    const int ray = wraps ? ((k % count) + count) % count : k;
    if (ray < 0 || ray >= count || sorted.ends[static_cast<std::size_t>(ray)] == RayEnd::kTooNear) {
      ++hidden;
      continue;
    }

    const auto range_m = std::min(static_cast<double>(scan.ranges_m[static_cast<std::size_t>(ray)]), scan.range_max_m);
    if (range_m >= behind_m) {
      ++through;
    } else if (range_m > before_m) {
      ++touching;
    } else {
      ++hidden;
    }
  }

  // A sixth of the rays on it: something is there. Four fifths through it: nothing is.
  if (touching > 0 && touching * 5 >= through + hidden) return Sight::kTouched;
  return through * 5 >= (through + touching + hidden) * 4 ? Sight::kFree : Sight::kOutOfView;
}

}  // namespace aisle::obstacle_tracker
