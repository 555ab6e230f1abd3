// C4, LI eq. 10 (Yheading): the smaller the angle from the trajectory's end to the sub-target, the better.
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// pi - |angle|, in [0, pi]; the sub-target is the point of the global path nearest to the vehicle, a look-ahead further on.
/// Looked at after the heading time, as C1.
double sub_target_heading_critic(const Sample& sample, const Aim& aim) {
  const double bearing = geometry::bearing(sample.look_in_map.position(), aim.sub_target_in_map);
  return geometry::kPi - std::abs(geometry::wrap(bearing - sample.look_in_map.yaw));
}

}  // namespace aisle::local_planner
