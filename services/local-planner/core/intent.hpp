#pragma once

#include <vector>

#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// Where the vehicle will be, for people: points from `way.s_m()` to `end_m`, with the time when it is there at the
/// profile's speeds, in s from now.
struct Intent {
  std::vector<IntentPoint> points;  // at most 7
  double time_left_s{0.0};          // to the way's end, beyond the points too
};

/// Points at equal steps along the way; each step takes its length over the profile's speed on it.
/// @param end_m of the current way, and no more than 24 m ahead
Intent intent_of(const Way& way, double end_m);

}  // namespace aisle::local_planner
