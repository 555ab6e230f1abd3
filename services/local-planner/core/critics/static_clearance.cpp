// C7, QU eq. 12: clearance to what stands.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 0 where the vehicle's centre is nearer than 1.2 R, else growing with the distance, capped. Repaired: eq.
/// 12 prints 1/D, which would reward driving close.
void static_clearance_critic(const Samples& samples, const Aim& aim, Lane& scores) {
  const double radius_m = aim.radius_m, wide_m = aim.radius_m + aim.wall_cap_m;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double center_m = radius_m + least(samples.wall_gap_m[i], samples.standing_gap_m[i]);
    scores[i] = center_m < 1.2 * radius_m ? 0.0 : least(1.0, center_m / wide_m);
  }
}

}  // namespace aisle::local_planner
