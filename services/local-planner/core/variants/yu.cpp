// L4, YU: the traditional critics, fast. Its turn rates are degrees, printed as radians. Its linear acceleration is not
// printed: 0.4 m/s^2 is chosen. Eq. 9 prints v + dv for the upper end of V_d: v + dv dt is meant.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.05;
constexpr double kClearance = 0.2;
constexpr double kVelocity = 0.5;

constexpr PaperLimits kPaper{/*max_speed_mps=*/2.0,
                             /*max_turn_radps=*/from_degrees(20.0),
                             /*max_acceleration_mps2=*/0.4,
                             /*max_deceleration_mps2=*/0.4,
                             /*max_turn_acceleration_radps2=*/from_degrees(50.0),
                             /*horizon_s=*/3.0};

/// Section 3.2: the path's points are sub-targets, one after the other; eq. 12: before it moves, the vehicle turns to
/// the first of them.
AsPrinted printed() {
  AsPrinted printed;
  printed.target_rule = target_rules::path_nodes;
  printed.faces_first_node = true;
  return printed;
}

}  // namespace

Variant yu() {
  return {"yu",
          {{heading_critic, kHeading, "alpha"},
           {clearance_critic, kClearance, "beta"},
           {velocity_critic, kVelocity, "gamma"}},
          true,
          kPaper,
          "as wang, speed counts for more",
          false,
          printed()};
}

}  // namespace aisle::local_planner
