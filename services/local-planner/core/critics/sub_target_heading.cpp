// C4, LI eq. 10 (Yheading): the smaller the angle from the trajectory's end to the sub-target, the better.
#include "services/local-planner/core/turns.hpp"

namespace aisle::local_planner {

/// pi - |angle|, in [0, pi]; the sub-target is the point of the global path nearest to the vehicle, a look-ahead
/// further on. Looked at after the heading time, as C1.
void sub_target_heading_critic(const Samples& samples, const Aim& aim, Lane& scores) {
  Lane turns_rad;
  find_turns_rad(samples, aim.sub_target_in_map, turns_rad);
  for (std::size_t i = 0; i < kLanes; ++i) scores[i] = geometry::kPi - turns_rad[i];
}

}  // namespace aisle::local_planner
