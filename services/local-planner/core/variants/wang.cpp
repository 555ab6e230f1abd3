// L5, WANG: "distance-and-log weighted A* + turning-point removal + DWA". Its DWA is the traditional one with the
// path's turning points as temporary targets; weights .05 heading, .2 clearance, .3 velocity. Its turn rates are
// degrees, printed as radians.
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

}  // namespace

Variant wang() {
  return {"wang",
          {{heading_critic, kHeading}, {clearance_critic, kClearance}, {velocity_critic, kVelocity}},
          true,
          kPaper,
          "turning points as targets"};
}

}  // namespace aisle::local_planner
