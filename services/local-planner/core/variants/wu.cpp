// L2, WU: a forklift; keeps to the path and, where a collision is predicted, to the local sub-target. Its printed
// minimum acceleration of 0 is read as -0.2 m/s^2.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.2;
constexpr double kVelocity = 0.3;
constexpr double kClearance = 0.15;
constexpr double kPathDistance = 0.2;
constexpr double kSubTargetDistance = 0.15;

constexpr PaperLimits kPaper{/*max_speed_mps=*/1.0,
                             /*max_turn_radps=*/0.35,
                             /*max_acceleration_mps2=*/0.2,
                             /*max_deceleration_mps2=*/0.2,
                             /*max_turn_acceleration_radps2=*/0.9,
                             /*horizon_s=*/3.0};

}  // namespace

Variant wu() {
  return {"wu",
          {{heading_critic, kHeading},
           {velocity_critic, kVelocity},
           {clearance_critic, kClearance},
           {path_distance_critic, kPathDistance},
           {sub_target_distance_critic, kSubTargetDistance}},
          true,
          kPaper,
          "keeps to the path, or to a sub-target beside who would be hit",
          true};
}

}  // namespace aisle::local_planner
