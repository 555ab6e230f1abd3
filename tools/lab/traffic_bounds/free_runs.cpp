#include "tools/lab/traffic_bounds/free_runs.hpp"

#include <limits>

namespace aisle::lab {

std::vector<GoalTimes> free_runs(const scenario::Scenario& fleet, std::size_t vehicles, const RunAlone& run) {
  std::vector<GoalTimes> times;
  for (std::size_t i = 0; i < vehicles && i < fleet.vehicles.size(); ++i) times.push_back(run(alone(fleet, i)));
  return times;
}

FleetOnGraph on_graph(const FloorModel& model, const scenario::Scenario& fleet) {
  const std::vector<bool> largest = in_largest_part(model.graph);
  FleetOnGraph out;
  std::vector<geometry::Point2> starts, first_goals;

  for (std::size_t i = 0; i < fleet.vehicles.size(); ++i) {
    starts.push_back(fleet.vehicles[i].start_in_map.position());
    first_goals.push_back(fleet.missions[i].goals_in_map.front().position());

    std::vector<Vertex> goals;
    for (const geometry::Pose2& goal : fleet.missions[i].goals_in_map)
      goals.push_back(nearest_vertex(model.graph, goal.position(), largest));
    out.goals.push_back(std::move(goals));
  }

  out.starts = distinct_vertices(model.graph, starts);
  out.distinct_first_goal = distinct_vertices(model.graph, first_goals);
  return out;
}

double seconds_a_step(const StepGraph& graph, const FleetOnGraph& fleet, const std::vector<GoalTimes>& free_runs,
                      double pause_s) {
  double seconds = 0.0, steps = 0.0;

  for (std::size_t i = 0; i < free_runs.size(); ++i) {
    const std::size_t goals = free_runs[i].size();
    if (goals == 0) continue;

    seconds += free_runs[i].back() - pause_s * static_cast<double>(goals - 1);
    Vertex from = fleet.starts[i];
    for (std::size_t k = 0; k < goals; ++k) {
      steps += steps_to(graph, fleet.goals[i][k])[from];
      from = fleet.goals[i][k];
    }
  }

  return steps > 0.0 ? seconds / steps : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace aisle::lab
