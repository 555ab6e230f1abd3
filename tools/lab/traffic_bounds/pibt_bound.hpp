#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tools/lab/traffic_bounds/pibt_step.hpp"

namespace aisle::lab {

/// What the bound is computed from.
struct PibtFleet {
  std::vector<Vertex> starts;              // of each vehicle, all different
  std::vector<std::vector<Vertex>> goals;  // of each vehicle, in order; the next one is given at once
};

struct PibtRun {
  std::uint64_t goals{0};  // reached by all vehicles together
  std::uint64_t steps{0};

  /// S_N: steps a goal and vehicle; infinity where no goal was reached.
  double steps_a_goal(std::size_t vehicles) const;
};

/// Lets plain PIBT run for so many unit steps. Of vehicles the one that has been on its way to its goal for longest
/// goes first; a vehicle that has reached all its goals stays where it may.
/// @param watch is shown the vertex of each vehicle at the beginning and after each step; may be empty
PibtRun run_pibt(const StepGraph& graph, const PibtFleet& fleet, std::uint64_t steps, std::uint64_t seed,
                 const std::function<void(const std::vector<Vertex>&)>& watch = {});

/// Goals a vehicle and hour of a fleet that needs `steps_a_goal` steps of `step_s` seconds and a pause at each goal.
double goals_per_vehicle_hour(double steps_a_goal, double step_s, double pause_s);

}  // namespace aisle::lab
