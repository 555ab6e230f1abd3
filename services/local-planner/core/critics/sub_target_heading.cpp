// C4, LI eq. 10 (Yheading): the smaller the angle from the trajectory's end to the sub-target, the better.
#include "services/local-planner/core/critics/turn.hpp"

namespace aisle::local_planner {

/// pi - |angle|, in [0, pi]; the sub-target is the point of the global path nearest to the vehicle, a look-ahead further on.
/// Looked at after the heading time, as C1.
double sub_target_heading_critic(const Sample& sample, const Aim& aim) { return geometry::kPi - turn_to_rad(sample, aim.sub_target_in_map); }

}  // namespace aisle::local_planner
