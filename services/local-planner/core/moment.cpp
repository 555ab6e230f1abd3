#include "services/local-planner/core/moment.hpp"

#include <algorithm>
#include <limits>

namespace aisle::local_planner {

// The nearest of the footprint's discs decides.
double Moment::gap_then_m(const Mover& mover) const {
  double least_m = std::numeric_limits<double>::infinity();
  for (const double ahead_m : discs.ahead_m)
    least_m = std::min(least_m,
                       geometry::distance(geometry::to_map(motion.base_then, {ahead_m, 0.0}), mover.position_in_map));

  return least_m - discs.radius_m - mover.radius_m;
}

}  // namespace aisle::local_planner
