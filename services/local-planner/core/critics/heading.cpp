// C1, all five papers: the smaller the angle from the trajectory's end to the target, the better.
#include "services/local-planner/core/critics/turn.hpp"

namespace aisle::local_planner {

/// pi - |angle|, in [0, pi], looked at where the trajectory is after the heading time: at the horizon a fast sample
/// has often passed a near target, and every angle there is as bad as any other.
double heading_critic(const Sample& sample, const Aim& aim) { return geometry::kPi - turn_to_rad(sample, aim.target_in_map); }

}  // namespace aisle::local_planner
