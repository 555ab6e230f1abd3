// L3, QU: clearance to what stands and to what moves are two critics.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

Variant qu() {
  return {
      "qu",
      {{heading_critic, 0.2}, {static_clearance_critic, 0.1}, {velocity_critic, 0.3}, {dynamic_clearance_critic, 0.4}},
      true,
      {2.0, from_degrees(40.0), 0.4, 0.4, from_degrees(60.0), 2.0},
      "clearance to what moves apart from what stands"};
}

}  // namespace aisle::local_planner
