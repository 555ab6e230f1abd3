// L0: the traditional dynamic window approach (Fox, Burgard, Thrun 1997) with WU's figures: it drives at the goal and
// knows no path.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

Variant dwa() {
  return {"dwa",
          {{heading_critic, 0.2}, {clearance_critic, 0.5}, {velocity_critic, 0.3}},
          false,
          {},
          "straight at the goal, without a path; for comparison"};
}

}  // namespace aisle::local_planner
