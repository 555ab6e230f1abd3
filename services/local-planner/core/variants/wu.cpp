// L2, WU: a forklift; keeps to the path and, where a collision is predicted, to the local sub-target. Its printed
// minimum acceleration of 0 is read as -0.2 m/s^2.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

Variant wu() {
  return {"wu",
          {{heading_critic, 0.2},
           {velocity_critic, 0.3},
           {clearance_critic, 0.15},
           {path_distance_critic, 0.2},
           {sub_target_distance_critic, 0.15}},
          true,
          {1.0, 0.35, 0.2, 0.2, 0.9, 3.0},
          "keeps to the path, or to a sub-target beside who would be hit",
          true};
}

}  // namespace aisle::local_planner
