#pragma once

#include <vector>

#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// The way that the vehicle claims: points from `way.s_m()` to `end_m`, with the time when it is there at the
/// profile's speeds, in s from now.
struct Claim {
  std::vector<IntentPoint> points;  // at most 62
  double time_left_s{0.0};          // to the way's end, beyond the claim too
};

/// Points at equal steps along the way; each step takes its length over the profile's speed at its end.
/// @param end_m of the current way, not claimed beyond; more than 24 m ahead is not claimed either
Claim claim_of(const Way& way, double end_m);

}  // namespace aisle::local_planner
