#include "tools/lab/traffic_bounds/traffic_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "tools/lab/traffic_bounds/free_runs.hpp"
#include "tools/lab/traffic_bounds/pibt_bound.hpp"
#include "tools/lab/traffic_bounds/site_run.hpp"

namespace aisle::lab {
namespace {

constexpr const char* kPlanner = "direct";  // of own ways

double rate_of(const std::vector<GoalTimes>& reached_s, std::size_t vehicles, double seconds) {
  std::size_t goals = 0;
  for (std::size_t i = 0; i < vehicles; ++i) goals += reached_s[i].size();
  return 3600.0 * static_cast<double>(goals) / (seconds * static_cast<double>(vehicles));
}

/// Sum of the times of each vehicle's last goal, to the same goals in its free run.
double time_to_alone(const std::vector<GoalTimes>& reached_s, const std::vector<GoalTimes>& free_runs) {
  double together_s = 0.0, alone_s = 0.0;

  for (std::size_t i = 0; i < reached_s.size() && i < free_runs.size(); ++i) {
    const std::size_t goals = std::min(reached_s[i].size(), free_runs[i].size());
    if (goals == 0) continue;
    together_s += reached_s[i][goals - 1];
    alone_s += free_runs[i][goals - 1];
  }

  return alone_s > 0.0 ? together_s / alone_s : 1.0;
}

/// One floor while it is measured.
class Measurement {
 public:
  Measurement(const Floor& floor, const TrafficExperiment& experiment, const Progress& progress)
      : experiment_(experiment), progress_(progress), model_(floor) {
    const std::size_t most = *std::max_element(experiment.vehicles.begin(), experiment.vehicles.end());
    fleet_ = draw_fleet(model_, experiment.seed, most, experiment.seconds);
    on_graph_ = on_graph(model_, fleet_);
    figures_.floor = floor.name;
    figures_.places = model_.graph.size();
  }

  FloorFigures run() {
    measure_free_runs();
    for (const std::size_t vehicles : experiment_.vehicles) {
      if (!goes_on()) break;
      FleetRow row = measure(vehicles);
      if (goes_on()) figures_.rows.push_back(std::move(row));
    }
    return figures_;
  }

 private:
  bool goes_on() const { return !experiment_.goes_on || experiment_.goes_on(); }

  void tell(const std::string& what) const {
    if (progress_) progress_(figures_.floor + ": " + what);
  }

  std::vector<GoalTimes> free_runs_of(std::size_t vehicles, const std::string& what, const RunAlone& run) {
    std::size_t begun = 0;
    return free_runs(fleet_, vehicles, [&](const scenario::Scenario& scenario) {
      tell(fmt::format("free run {} of {}, {}", ++begun, vehicles, what));
      return goes_on() ? run(scenario) : GoalTimes{};
    });
  }

  void measure_free_runs() {
    std::size_t most = 0;
    for (const std::size_t vehicles : experiment_.vehicles)
      if (vehicles <= kMostDriven) most = std::max(most, vehicles);

    // Seconds a step are always those of the same vehicles.
    const std::size_t of_step = std::min(kFreeRunsOfStep, fleet_.vehicles.size());
    const auto kinematic = [this](const std::string& planner) {
      return [this, planner](const scenario::Scenario& scenario) {
        return run_kinematic(scenario, experiment_.seed, planner, experiment_.goes_on).reached_s.front();
      };
    };
    const auto on_site = [this](const scenario::Scenario& scenario) {
      return run_on_site(scenario, model_.grid, experiment_.seed, experiment_.goes_on).reached_s.front();
    };

    free_runs_ = free_runs_of(std::max(most, of_step), "own ways", kinematic(kPlanner));
    figures_.step_s = step_s(free_runs_);
    figures_.roadmap_step_s = step_s(free_runs_of(of_step, "by the roadmap", kinematic("")));
    if (experiment_.with_site) figures_.site_step_s = step_s(free_runs_of(of_step, "on the simulated site", on_site));
  }

  double step_s(std::vector<GoalTimes> runs) const {
    runs.resize(std::min(runs.size(), kFreeRunsOfStep));
    return seconds_a_step(model_.graph, on_graph_, runs, kPauseS);
  }

  FleetRow measure(std::size_t vehicles) {
    FleetRow row;
    row.vehicles = vehicles;
    measure_bound(row);

    if (vehicles <= kMostDriven) {
      measure_reached(row);
      if (goes_on()) measure_one_shot(row);
    }

    if (goes_on()) {
      tell(fmt::format("{} vehicles, plans from nothing", vehicles));
      row.plans = plan_from_nothing(model_, first_of(fleet_, vehicles));
    }

    if (experiment_.with_site && vehicles <= kMostDriven && goes_on()) measure_on_site(row);
    return row;
  }

  void measure_bound(FleetRow& row) {
    tell(fmt::format("{} vehicles, PIBT", row.vehicles));
    PibtFleet fleet{on_graph_.starts, on_graph_.goals};
    fleet.starts.resize(row.vehicles);
    fleet.goals.resize(row.vehicles);

    const auto steps = static_cast<std::uint64_t>(std::max(1.0, experiment_.seconds / figures_.step_s));
    row.steps_a_goal = run_pibt(model_.graph, fleet, steps, experiment_.seed).steps_a_goal(row.vehicles);
    row.bound = goals_per_vehicle_hour(row.steps_a_goal, figures_.step_s, kPauseS);
    row.roadmap_bound = goals_per_vehicle_hour(row.steps_a_goal, figures_.roadmap_step_s, kPauseS);
    if (figures_.site_step_s) row.site_bound = goals_per_vehicle_hour(row.steps_a_goal, *figures_.site_step_s, kPauseS);
  }

  void measure_reached(FleetRow& row) {
    tell(fmt::format("{} vehicles, {:.0f} s", row.vehicles, experiment_.seconds));
    row.alone = rate_of(free_runs_, row.vehicles, experiment_.seconds);

    FleetRun run = run_kinematic(first_of(fleet_, row.vehicles), experiment_.seed, kPlanner, experiment_.goes_on);
    run.figures.time_to_alone = time_to_alone(run.reached_s, free_runs_);
    row.reached = run.figures;
  }

  /// The free run with many goals, unless it ended before the first one.
  GoalTimes free_run_to_first_goal(std::size_t vehicle, const scenario::Scenario& one_shot) const {
    if (!free_runs_[vehicle].empty()) return free_runs_[vehicle];
    return run_kinematic(alone(one_shot, vehicle), experiment_.seed, kPlanner, experiment_.goes_on).reached_s.front();
  }

  void measure_one_shot(FleetRow& row) {
    tell(fmt::format("{} vehicles, one goal each", row.vehicles));
    scenario::Scenario scenario = first_of(fleet_, row.vehicles, 1);
    scenario.duration_s = 2.0 * experiment_.seconds;
    const FleetRun run = run_kinematic(scenario, experiment_.seed, kPlanner, experiment_.goes_on);

    OneShotFigures one_shot;
    for (std::size_t i = 0; i < row.vehicles; ++i) {
      const GoalTimes free_run = free_run_to_first_goal(i, scenario);
      if (run.reached_s[i].empty() || free_run.empty()) continue;

      ++one_shot.goals;
      one_shot.makespan_s = std::max(one_shot.makespan_s, run.reached_s[i].front());
      one_shot.alone_makespan_s = std::max(one_shot.alone_makespan_s, free_run.front());
      one_shot.ends_s += run.reached_s[i].front();
      one_shot.alone_ends_s += free_run.front();
    }

    std::vector<Vertex> starts = on_graph_.starts, goals = on_graph_.distinct_first_goal;
    starts.resize(row.vehicles);
    goals.resize(row.vehicles);
    tell(fmt::format("{} vehicles, one goal each, multi-agent plan", row.vehicles));
    if (const auto plan = plan_one_shot(model_.graph, starts, goals, experiment_.seed, experiment_.one_shot)) {
      one_shot.plan_cost = plan->cost;
      one_shot.plan_least_cost = plan->least_cost;
    }

    row.one_shot = one_shot;
  }

  void measure_on_site(FleetRow& row) {
    tell(fmt::format("{} vehicles, {:.0f} s on the simulated site", row.vehicles, experiment_.seconds));
    FleetRun run = run_on_site(first_of(fleet_, row.vehicles), model_.grid, experiment_.seed, experiment_.goes_on);
    run.figures.time_to_alone = time_to_alone(run.reached_s, free_runs_);
    row.site = run.figures;
  }

  const TrafficExperiment& experiment_;
  const Progress& progress_;
  FloorModel model_;
  scenario::Scenario fleet_;
  FleetOnGraph on_graph_;
  std::vector<GoalTimes> free_runs_;
  FloorFigures figures_;
};

}  // namespace

FloorFigures measure_floor(const Floor& floor, const TrafficExperiment& experiment, const Progress& progress) {
  return Measurement(floor, experiment, progress).run();
}

}  // namespace aisle::lab
