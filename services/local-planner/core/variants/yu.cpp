// L4, YU: the traditional critics, fast; turns on the spot to the path's first node before it moves (eq. 12, with
// atan2), as every variant here does. Its turn rates are degrees, printed as radians.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

Variant yu() {
  return {"yu",
          {{heading_critic, 0.05}, {clearance_critic, 0.2}, {velocity_critic, 0.5}},
          true,
          {2.0, from_degrees(20.0), 0.4, 0.4, from_degrees(50.0), 3.0},
          "as wang, faster"};
}

}  // namespace aisle::local_planner
