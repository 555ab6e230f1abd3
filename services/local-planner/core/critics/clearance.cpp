// C2 (LI, WU, YU, WANG): least clearance along the trajectory, capped, so that open space has no pull of its own.
#include <algorithm>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]; the worse of walls and of what moves, each as a share of its cap.
double clearance_critic(const Sample& sample, const Aim& aim) {
  const double walls = std::clamp(sample.wall_gap_m / aim.wall_cap_m, 0.0, 1.0);
  const double movers = std::clamp(sample.mover_gap_m / aim.mover_cap_m, 0.0, 1.0);
  return std::min(walls, movers);
}

}  // namespace aisle::local_planner
