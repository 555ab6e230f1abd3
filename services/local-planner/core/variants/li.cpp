// L1, LI: the traditional critics and the heading to the sub-target on the global path.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

Variant li() {
  return {"li",
          {{heading_critic, 0.05}, {clearance_critic, 0.2}, {velocity_critic, 0.3}, {sub_target_heading_critic, 0.1}},
          true,
          {},
          "heads for a sub-target on the path as well"};
}

}  // namespace aisle::local_planner
