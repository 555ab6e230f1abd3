#include "tools/lab/traffic_bounds/site_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tools/lab/traffic/kinematic_site.hpp"
#include "tools/sim/site.hpp"
#include "tools/sim/totals.hpp"

namespace aisle::lab {
namespace {

void count_served(FleetRun& run) {
  const auto [least, most] =
      std::minmax_element(run.reached_s.begin(), run.reached_s.end(),
                          [](const GoalTimes& a, const GoalTimes& b) { return a.size() < b.size(); });
  if (least == run.reached_s.end()) return;
  run.figures.least_served = static_cast<int>(least->size());
  run.figures.most_served = static_cast<int>(most->size());
}

StandFigures figures_of(const sim::LongestStand& stand) {
  if (stand.seconds <= 0.0) return {};
  return {stand.seconds, fmt::format("{} at {:.0f} s: {}", stand.agv_id, stand.begin_s, stand.cause)};
}

}  // namespace

FleetRun run_kinematic(const scenario::Scenario& scenario, std::uint64_t seed, const std::string& planner,
                       const std::function<bool()>& goes_on) {
  TrafficRunSettings settings;
  settings.seed = seed;
  settings.planner = planner;
  settings.goes_on = goes_on;
  const TrafficRun run = KinematicSite(scenario, settings).run();

  FleetRun out;
  for (const scenario::Vehicle& vehicle : scenario.vehicles) {
    const auto reached = run.reached_s.find(vehicle.id);
    out.reached_s.push_back(reached == run.reached_s.end() ? GoalTimes{} : reached->second);
  }

  ReachedFigures& figures = out.figures;
  figures.goals = run.goals;
  figures.goals_per_vehicle_hour = run.goals_per_vehicle_hour(scenario.vehicles.size());
  figures.own_way_share = run.own_way_share;
  figures.standoff = figures_of(run.standoff);
  figures.wait = figures_of(run.wait);
  figures.findings =
      run.contacts + run.wall_contacts + run.off_road + run.held_twice + static_cast<int>(run.refused + run.circles);
  if (!run.findings.empty()) figures.first_finding = run.findings.front();
  figures.step_ms_mean = run.step_ms_mean;
  figures.step_ms_p99 = run.step_ms_p99;
  count_served(out);
  return out;
}

FleetRun run_on_site(const scenario::Scenario& scenario, const grid::OccupancyGrid& grid, std::uint64_t seed,
                     const std::function<bool()>& goes_on) {
  sim::Setup setup;
  setup.scenario = scenario;
  setup.grid = grid;
  setup.seed = seed;

  sim::Hooks hooks;
  if (goes_on) hooks.goes_on = [&goes_on](double) { return goes_on(); };
  const sim::Outcome outcome = sim::drive(setup, {}, hooks);
  sim::Totals totals;
  totals.add(outcome.result);

  FleetRun out;
  std::map<std::string, GoalTimes> reached;
  for (const referee::GoalRecord& goal : outcome.report.goals)
    if (goal.outcome == referee::GoalOutcome::kReached)
      reached[goal.agv_id].push_back(goal.decided_s - outcome.result.first_goal_s);
  for (const scenario::Vehicle& vehicle : scenario.vehicles) out.reached_s.push_back(reached[vehicle.id]);

  ReachedFigures& figures = out.figures;
  figures.goals = outcome.result.goals_reached;
  figures.goals_per_vehicle_hour = totals.goals_per_vehicle_hour().value_or(0.0);
  figures.own_way_share = totals.own_way_share().value_or(0.0);
  figures.standoff = {totals.longest_standoff_s, totals.longest_standoff};
  figures.wait = {totals.longest_wait_s, totals.longest_wait};
  figures.findings = totals.contacts_moving_vehicle + static_cast<int>(outcome.report.violations.size());
  count_served(out);
  return out;
}

}  // namespace aisle::lab
