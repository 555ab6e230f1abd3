// C6, WU eq. 5 (dist-2): the nearer the trajectory's end comes to the local sub-target, the better.
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In [0, 1]: 1 at the sub-target, 0 from 3 m off it. Looked at where the trajectory is after the heading time: at the
/// horizon a fast sample has passed a near sub-target, and would lose to one that stands. A reward, as C5.
void sub_target_distance_critic(const Samples& samples, const Aim& aim, Lane& scores) {
  constexpr double kFarM = 3.0;
  const geometry::Point2 target = aim.target_in_map;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = samples.look_x_m[i] - target.x, y = samples.look_y_m[i] - target.y;
    scores[i] = within(1.0 - std::sqrt(x * x + y * y) / kFarM, 0.0, 1.0);
  }
}

}  // namespace aisle::local_planner
