// L3, QU: clearance to what stands and to what moves are two critics. Its prediction time is not printed: 2 s is
// chosen.
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

/// Section 4: the key points of the path are intermediate targets. Table 1: the initial azimuth is -pi/2, the
/// resolutions are 0.01 m/s and 1 deg/s, dt is 0.1 s.
AsPrinted printed() {
  AsPrinted printed;
  printed.target_rule = target_rules::path_nodes;
  printed.start_yaw_rad = -0.5 * geometry::kPi;
  printed.linear_step_mps = 0.01;
  printed.angular_step_radps = from_degrees(1.0);
  printed.interval_s = 0.1;
  return printed;
}

}  // namespace

Variant qu() {
  return {"qu",
          {{heading_critic, kHeading, "alpha"},
           {static_clearance_critic, kStaticClearance, "beta"},
           {velocity_critic, kVelocity, "gamma"},
           {dynamic_clearance_critic, kDynamicClearance, "eta"}},
          true,
          kPaper,
          "clearance to what moves apart from what stands",
          false,
          printed()};
}

}  // namespace aisle::local_planner
