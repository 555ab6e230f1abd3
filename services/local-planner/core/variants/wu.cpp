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

/// Sections 4 and 5: the local sub-target while a collision is predicted, else the path. Section 3.2: an Ackermann
/// forklift. Table 1: dt is 0.1 s.
AsPrinted printed() {
  AsPrinted printed;
  printed.target_rule = target_rules::local_sub_target;
  printed.model = kinematics::Model::kTricycle;
  printed.interval_s = 0.1;
  return printed;
}

}  // namespace

Variant wu() {
  return {"wu",
          {{heading_critic, kHeading, "alpha"},
           {velocity_critic, kVelocity, "beta"},
           {clearance_critic, kClearance, "gamma"},
           {path_distance_critic, kPathDistance, "eta"},
           {sub_target_distance_critic, kSubTargetDistance, "lambda"}},
          true,
          kPaper,
          "keeps to the path, or to a sub-target beside who would be hit",
          true,
          printed()};
}

}  // namespace aisle::local_planner
