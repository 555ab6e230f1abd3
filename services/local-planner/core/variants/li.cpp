// L1, LI: the traditional critics and the heading to the sub-target on the global path. Table III calls gamma "dynamic
// distance"; eq. 10 gives it to the speed, and so does this. Eq. 6 prints a minus on both sides of w: V_d reaches from
// w - dw dt to w + dw dt.
//
// Section IV.C wants the car to slow down before turns and obstacles and prints eq. 10 as the only means, so the
// variant has no other: as printed nothing else slows it, and in our own drive the way's profile (SpeedPolicy) slows
// every variant alike. "LI section IV.C" of `aisle lab reproduce` measures what eq. 10 does by itself.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.05;
constexpr double kClearance = 0.2;
constexpr double kVelocity = 0.3;
constexpr double kSubTargetHeading = 0.1;

/// Section IV.C: the sub-goal G_i is the path's nearest point. No limits are printed.
AsPrinted printed() {
  AsPrinted printed;
  printed.target_rule = target_rules::nearest_path_point;
  return printed;
}

}  // namespace

Variant li() {
  return {"li",
          {{heading_critic, kHeading, "alpha"},
           {clearance_critic, kClearance, "beta"},
           {velocity_critic, kVelocity, "gamma"},
           {sub_target_heading_critic, kSubTargetHeading, "eta"}},
          true,
          {},
          "heads for a sub-target on the path as well",
          false,
          printed()};
}

}  // namespace aisle::local_planner
