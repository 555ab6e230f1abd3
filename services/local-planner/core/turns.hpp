#pragma once
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// What each sample, after the heading time, has left to turn from its heading to a point: in [0, pi].
void find_turns_rad(const Samples& samples, geometry::Point2 target_in_map, Lane& turns_rad);

}  // namespace aisle::local_planner
