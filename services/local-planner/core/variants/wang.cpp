// L5, WANG: "distance-and-log weighted A* + turning-point removal + DWA". Its DWA is the traditional one with the
// path's turning points as temporary targets; weights .05 heading, .2 clearance, .3 velocity. Its turn rates are
// degrees, printed as radians.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

Variant wang() {
  return {"wang",
          {{heading_critic, 0.05}, {clearance_critic, 0.2}, {velocity_critic, 0.3}},
          true,
          {1.5, from_degrees(40.0), 1.0, 1.0, from_degrees(50.0), 2.0},
          "turning points as targets"};
}

}  // namespace aisle::local_planner
