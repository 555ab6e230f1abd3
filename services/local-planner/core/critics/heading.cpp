// C1, all five papers: the smaller the angle from the trajectory's end to the target, the better.
#include "services/local-planner/core/turns.hpp"

namespace aisle::local_planner {

/// pi - |angle|, in [0, pi], looked at where the trajectory is after the heading time: at the horizon a fast sample
/// has often passed a near target, and every angle there is as bad as any other.
void heading_critic(const Samples& samples, const Aim& aim, Lane& scores) {
  Lane turns_rad;
  find_turns_rad(samples, aim.target_in_map, turns_rad);
  for (std::size_t i = 0; i < kLanes; ++i) scores[i] = geometry::kPi - turns_rad[i];
}

}  // namespace aisle::local_planner
