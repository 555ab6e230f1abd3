#pragma once

// What comes into the fleet planner and what goes out, in its own types. Everything in map, metres, radians.
#include <cstdint>
#include <string>
#include <vector>

#include "common/fleet/goal.hpp"
#include "common/fleet/navigation.hpp"
#include "common/fleet/plan.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::global_planner {

/// Margins, times and distances of the fleet planner.
struct FleetSettings {
  double margin_m{0.10};       // kept free beside the vehicle's radius
  double tight_range_m{1.5};   // around a start or goal too near to something for the margin
  double replan_s{1.0};        // least time between two plans for one vehicle and goal, doubled while they do not help
  double longest_wait_s{8.0};  // between attempts that do not help
  double state_life_s{1.0};    // a vehicle silent for longer is not planned for
  double preferred_clearance_m{
      0.0};  // for the planner `clear`: nearer to obstacles a metre costs more; 0: twice radius and margin
  double safe_distance_m{0.3};  // for the planners `qu` and `yu`: between the vehicle and obstacles, beside their lines
  bool as_printed{false};  // by the map alone: what it does not show changes no plan; lines also for steered vehicles
  bool to_nearest{false};  // where the map leaves no way to a goal, plan to the nearest point that can be reached

  template <class Reader>
  void describe(Reader& r) {
    r.field("margin_m", margin_m, 0.0, 2.0)
        .field("tight_range_m", tight_range_m, 0.0, 10.0)
        .field("replan_s", replan_s, 0.5, 60.0)
        .field("longest_wait_s", longest_wait_s, 0.5, 600.0)
        .field("state_life_s", state_life_s, 0.1, 60.0)
        .field("preferred_clearance_m", preferred_clearance_m, 0.0, 10.0)
        .field("safe_distance_m", safe_distance_m, 0.0, 10.0)
        .field("to_nearest", to_nearest);
  }
};

/// What a vehicle needs of the floor.
struct VehicleShape {
  double radius_m{0.35};  // of the disc around its base that keeps clear of walls
  double reach_m{0.35};   // of the circle around its base that holds all of it: where it stands, others go round that
  double turning_radius_m{0.0};         // of the tightest arc that plans have; 0: it turns on the spot
  std::vector<double> discs_ahead_m{};  // of one that does not: centres of the discs of radius_m that cover it
};

using fleet::Goal;
using fleet::NavigationStatus;
using fleet::Phase;
using fleet::Plan;
using fleet::PlanOutcome;
using fleet::PlanTrigger;
using fleet::Reason;

}  // namespace aisle::global_planner
