// L4, YU: the traditional critics, fast; turns on the spot to the path's first node before it moves (eq. 12, with
// atan2), as every variant here does. Its turn rates are degrees, printed as radians.
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

}  // namespace

Variant yu() {
  return {"yu",
          {{heading_critic, kHeading}, {clearance_critic, kClearance}, {velocity_critic, kVelocity}},
          true,
          kPaper,
          "as wang, faster"};
}

}  // namespace aisle::local_planner
