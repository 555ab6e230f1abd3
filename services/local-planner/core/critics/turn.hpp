#pragma once
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// What is left to turn from a sample's heading, after the heading time, to a point: in [0, pi].
inline double turn_to_rad(const Sample& sample, geometry::Point2 target_in_map) {
  const double apart = std::abs(geometry::bearing(sample.look_in_map.position(), target_in_map) - sample.look_in_map.yaw);
  if (apart <= geometry::kPi) return apart;
  return apart <= 2.0 * geometry::kPi ? 2.0 * geometry::kPi - apart : std::abs(geometry::wrap(apart));
}

}  // namespace aisle::local_planner
