// C2 (LI, WU, YU, WANG): least clearance along the trajectory, capped, so that open space has no pull of its own.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]; the worse of walls and of what moves, each as a share of its cap.
void clearance_critic(const Samples& samples, const Aim& aim, Lane& scores) {
  const double wall_cap_m = aim.wall_cap_m, mover_cap_m = aim.mover_cap_m;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double walls = within(samples.wall_gap_m[i] / wall_cap_m, 0.0, 1.0);
    const double movers = within(samples.mover_gap_m[i] / mover_cap_m, 0.0, 1.0);
    scores[i] = least(walls, movers);
  }
}

}  // namespace aisle::local_planner
