// C7, QU eq. 12: clearance to what stands.
#include <algorithm>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 0 where the vehicle's centre is nearer than 1.2 R, else growing with the distance, capped. Repaired: eq. 12 prints 1/D,
/// which would reward driving close.
double static_clearance_critic(const Sample& sample, const Aim& aim) {
  const double center_m = aim.radius_m + std::min(sample.wall_gap_m, sample.standing_gap_m);
  if (center_m < 1.2 * aim.radius_m) return 0.0;
  return std::min(1.0, center_m / (aim.radius_m + aim.wall_cap_m));
}

}  // namespace aisle::local_planner
