#pragma once
#include <cmath>

#include "common/geometry/bearings.hpp"
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// What is left to turn from a sample's heading, after the heading time, to a point: in [0, pi].
inline double turn_to_rad(const Sample& sample, geometry::Point2 target_in_map) {
  double bearing_rad;
  geometry::find_bearing_rad(target_in_map.y - sample.look_in_map.y, target_in_map.x - sample.look_in_map.x, bearing_rad);
  const double apart = std::abs(bearing_rad - sample.look_in_map.yaw);
  if (apart <= geometry::kPi) return apart;
  return apart <= 2.0 * geometry::kPi ? 2.0 * geometry::kPi - apart : std::abs(geometry::wrap(apart));
}

}  // namespace aisle::local_planner
