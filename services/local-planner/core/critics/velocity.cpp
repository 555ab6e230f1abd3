// C3, all five papers: the faster, the better.
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// m/s
void velocity_critic(const Samples& samples, const Aim&, Lane& scores) {
  for (std::size_t i = 0; i < kLanes; ++i) scores[i] = std::abs(samples.linear_mps[i]);
}

}  // namespace aisle::local_planner
