// C6, WU eq. 5 (dist-2): the nearer the trajectory's end comes to the local sub-target, the better.
#include <algorithm>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 1 at the sub-target, 0 from 3 m off it. Looked at where the trajectory is after the heading time: at the horizon a fast
/// sample has passed a near sub-target, and would lose to one that stands. A reward, as C5.
double sub_target_distance_critic(const Sample& sample, const Aim& aim) {
  constexpr double kFarM = 3.0;
  return std::clamp(1.0 - geometry::distance(sample.look_in_map.position(), aim.target_in_map) / kFarM, 0.0, 1.0);
}

}  // namespace aisle::local_planner
