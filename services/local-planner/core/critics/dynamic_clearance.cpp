// C8, QU eq. 15: clearance to what moves, where it will be at that time.
#include <algorithm>
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 0 where the gap is less than 1.2 of what the vehicle drives in a step, else growing with the gap, capped. Repaired: eq. 15
/// prints 1/D, which would reward driving close.
double dynamic_clearance_critic(const Sample& sample, const Aim& aim) {
  if (sample.moving_gap_m < 1.2 * std::abs(sample.twist.linear_mps) * aim.step_s) return 0.0;
  return std::clamp(sample.moving_gap_m / aim.mover_cap_m, 0.0, 1.0);
}

}  // namespace aisle::local_planner
