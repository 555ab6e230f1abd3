// C5, WU eq. 5 (dist-1): the nearer the trajectory keeps to the global path, the better.
#include <algorithm>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 1 on the path, 0 from 1 m off it. Repaired: WU says that the lowest cost wins, while its heading and velocity terms
/// are rewards; here all are rewards.
double path_distance_critic(const Sample& sample, const Aim&) { return std::clamp(1.0 - sample.path_distance_m, 0.0, 1.0); }

}  // namespace aisle::local_planner
