// L0: the traditional dynamic window approach (Fox, Burgard, Thrun 1997) with WU's figures: it drives at the goal and
// knows no path.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.2;
constexpr double kClearance = 0.5;
constexpr double kVelocity = 0.3;

}  // namespace

Variant dwa() {
  return {"dwa",
          {{heading_critic, kHeading, "alpha"},
           {clearance_critic, kClearance, "gamma"},
           {velocity_critic, kVelocity, "beta"}},
          false,
          {},
          "straight at the goal, without a path; for comparison"};
}

}  // namespace aisle::local_planner
