#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "tools/lab/traffic_bounds/fleet_case.hpp"

namespace aisle::lab {

/// When a vehicle reached its goals, one after the other; seconds since the beginning of the run.
using GoalTimes = std::vector<double>;

/// Runs a scenario of one vehicle. @return when it reached its goals
using RunAlone = std::function<GoalTimes(const scenario::Scenario& scenario)>;

/// Each of the first `vehicles` of the fleet alone on its missions: nothing that the traffic does can be sooner.
std::vector<GoalTimes> free_runs(const scenario::Scenario& fleet, std::size_t vehicles, const RunAlone& run);

/// Vertices of the starts, and of the goals of each vehicle.
struct FleetOnGraph {
  std::vector<Vertex> starts;               // all different
  std::vector<std::vector<Vertex>> goals;   // the nearest ones
  std::vector<Vertex> distinct_first_goal;  // the nearest ones that no vehicle before has
};
FleetOnGraph on_graph(const FloorModel& model, const scenario::Scenario& fleet);

/// tau: seconds that these free runs take a step of the shortest ways on the roadmap, pauses at goals left out.
/// NaN where no goal was reached.
double seconds_a_step(const StepGraph& graph, const FleetOnGraph& fleet, const std::vector<GoalTimes>& free_runs,
                      double pause_s);

}  // namespace aisle::lab
