// L1, LI: the traditional critics and the heading to the sub-target on the global path.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.05;
constexpr double kClearance = 0.2;
constexpr double kVelocity = 0.3;
constexpr double kSubTargetHeading = 0.1;

}  // namespace

Variant li() {
  return {"li",
          {{heading_critic, kHeading},
           {clearance_critic, kClearance},
           {velocity_critic, kVelocity},
           {sub_target_heading_critic, kSubTargetHeading}},
          true,
          {},
          "heads for a sub-target on the path as well"};
}

}  // namespace aisle::local_planner
