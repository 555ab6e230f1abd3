// L3, QU: clearance to what stands and to what moves are two critics.
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

// Weights.
constexpr double kHeading = 0.2;
constexpr double kStaticClearance = 0.1;
constexpr double kVelocity = 0.3;
constexpr double kDynamicClearance = 0.4;

constexpr PaperLimits kPaper{/*max_speed_mps=*/2.0,
                             /*max_turn_radps=*/from_degrees(40.0),
                             /*max_acceleration_mps2=*/0.4,
                             /*max_deceleration_mps2=*/0.4,
                             /*max_turn_acceleration_radps2=*/from_degrees(60.0),
                             /*horizon_s=*/2.0};

}  // namespace

Variant qu() {
  return {"qu",
          {{heading_critic, kHeading},
           {static_clearance_critic, kStaticClearance},
           {velocity_critic, kVelocity},
           {dynamic_clearance_critic, kDynamicClearance}},
          true,
          kPaper,
          "clearance to what moves apart from what stands"};
}

}  // namespace aisle::local_planner
