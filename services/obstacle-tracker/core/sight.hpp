#pragma once

#include "services/obstacle-tracker/core/hits.hpp"

namespace aisle::obstacle_tracker {

/// What a scan says of a place where a thing was expected and not found.
enum class Sight {
  kOutOfView,  // behind something, beyond the range, or outside the angles: nothing is known
  kTouched,    // rays end there: something is there, if not apart from a wall or another thing
  kFree,       // rays go through: nothing is there
};

/// Looks at the disc of `radius_m` around `place_in_map`, made wider by `doubt_m`, the standard deviation of the place.
/// kFree only if at least four fifths of the rays towards it end behind it.
Sight look_for(const Scan& scan, const SortedScan& sorted, geometry::Point2 place_in_map, double radius_m,
               double doubt_m);

}  // namespace aisle::obstacle_tracker
