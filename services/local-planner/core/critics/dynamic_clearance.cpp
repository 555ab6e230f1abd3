// C8, QU eq. 15: clearance to what moves, where it will be at that time.
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 0 where the gap is less than 1.2 of what the vehicle drives in a step, else growing with the gap, capped.
/// Repaired: eq. 15 prints 1/D, which would reward driving close.
void dynamic_clearance_critic(const Samples& samples, const Aim& aim, Lane& scores) {
  const double step_s = aim.step_s, mover_cap_m = aim.mover_cap_m;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double least_m = 1.2 * std::abs(samples.linear_mps[i]) * step_s;
    const double growing = within(samples.moving_gap_m[i] / mover_cap_m, 0.0, 1.0);
    scores[i] = samples.moving_gap_m[i] < least_m ? 0.0 : growing;
  }
}

}  // namespace aisle::local_planner
