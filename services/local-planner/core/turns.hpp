#pragma once

#include "common/geometry/batch.hpp"
#include "common/geometry/bearings.hpp"
#include "services/local-planner/core/samples.hpp"

namespace aisle::local_planner {

/// What a sample, where it is after the heading time, has left to turn until it faces a point: in [0, pi] rad.
template <class Number>
[[gnu::always_inline]] inline Number turn_left_rad(const Sample<Number>& sample, geometry::Point2 target_in_map) {
  const Number bearing_rad =
      geometry::bearing_rad<Number>(target_in_map.y - sample.look_y_m, target_in_map.x - sample.look_x_m);
  const Number apart_rad = bearing_rad - sample.look_yaw_rad;
  const Number one_way_rad = apart_rad < 0.0 ? -apart_rad : apart_rad;
  const Number other_way_rad = 2.0 * geometry::kPi - one_way_rad;

  return geometry::least(other_way_rad, one_way_rad);
}

}  // namespace aisle::local_planner
