// C5, WU eq. 5 (dist-1): the nearer the trajectory keeps to the global path, the better.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 1 on the path, 0 from 1 m off it. Repaired: WU says that the lowest cost wins, while its heading and
/// velocity terms are rewards; here all are rewards.
void path_distance_critic(const Samples& samples, const Aim&, Lane& scores) {
  for (std::size_t i = 0; i < kLanes; ++i) scores[i] = within(1.0 - samples.path_distance_m[i], 0.0, 1.0);
}

}  // namespace aisle::local_planner
