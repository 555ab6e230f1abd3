// C3, all five papers: the faster, the better.
#include <cmath>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// m/s
double velocity_critic(const Sample& sample, const Aim&) { return std::abs(sample.twist.linear_mps); }

}  // namespace aisle::local_planner
