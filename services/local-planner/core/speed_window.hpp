#pragma once

#include <vector>

#include "services/local-planner/core/rollout.hpp"

namespace aisle::local_planner {

/// The samples: twists that the vehicle can reach within the window. Neighbours in turn and speed come one after the
/// other, since they end at the same walls and so are done together in a block.
std::vector<geometry::Twist2> speed_window(const Scene& scene, const DwaSettings& settings);

}  // namespace aisle::local_planner
