// L5, WANG: "distance-and-log weighted A* + turning-point removal + DWA". Its DWA is the traditional one;
// weights .05 heading, .2 clearance, .3 velocity. Its turn rates are degrees, printed as radians. The turning points
// are its temporary targets where it drives as printed; our own drive aims at the way in sight, as all variants do.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.05;
constexpr double kClearance = 0.2;
constexpr double kVelocity = 0.3;

constexpr PaperLimits kPaper{/*max_speed_mps=*/1.5,
                             /*max_turn_radps=*/from_degrees(40.0),
                             /*max_acceleration_mps2=*/1.0,
                             /*max_deceleration_mps2=*/1.0,
                             /*max_turn_acceleration_radps2=*/from_degrees(50.0),
                             /*horizon_s=*/2.0};

/// Section 4 (3): the critical turning points are temporary targets. Section 5: the resolutions are 0.05 m/s and 1
/// deg/s (printed as rad/s).
AsPrinted printed() {
  AsPrinted printed;
  printed.target_rule = target_rules::turning_points;
  printed.linear_step_mps = 0.05;
  printed.angular_step_radps = from_degrees(1.0);
  return printed;
}

}  // namespace

Variant wang() {
  return {"wang",
          {{heading_critic, kHeading, "alpha"},
           {clearance_critic, kClearance, "beta"},
           {velocity_critic, kVelocity, "gamma"}},
          true,
          kPaper,
          "heading, clearance, speed; as printed, turning points as targets",
          false,
          printed()};
}

}  // namespace aisle::local_planner
