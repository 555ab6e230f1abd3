#pragma once

#include <functional>

#include "common/scenario/scenario.hpp"
#include "tools/lab/traffic_bounds/fleet_figures.hpp"
#include "tools/lab/traffic_bounds/free_runs.hpp"

namespace aisle::lab {

/// What a fleet did, and when each vehicle reached its goals.
struct FleetRun {
  ReachedFigures figures;
  std::vector<GoalTimes> reached_s;  // in the order of the scenario's vehicles
};

/// With vehicles that follow their granted road exactly (tools/lab/traffic).
/// @param planner of the vehicles' own ways; empty: all drive by the roadmap
/// @param goes_on asked once a simulated second; false ends the run; may be empty
FleetRun run_kinematic(const scenario::Scenario& scenario, std::uint64_t seed, const std::string& planner,
                       const std::function<bool()>& goes_on);

/// With all services on the simulated site (tools/sim): local planners, scans, tracker.
FleetRun run_on_site(const scenario::Scenario& scenario, const grid::OccupancyGrid& grid, std::uint64_t seed,
                     const std::function<bool()>& goes_on);

}  // namespace aisle::lab
