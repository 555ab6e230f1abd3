// Scenarios of traffic with vehicles that follow their granted road exactly (tools/lab/traffic): goals, times,
// stand-offs and what the judge of the floor found, one line a run. usage: traffic_cases SCENARIO... [--seeds N]
// [--disturbed] [--planner NAME] [--leader-forgets-at S] [--findings]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "tools/lab/traffic/kinematic_site.hpp"

namespace {

using namespace aisle;

struct Options {
  std::vector<std::string> files;
  std::uint64_t first_seed{1};
  int seeds{1};
  bool is_disturbed{false};
  std::string planner{"direct"};
  double leader_forgets_at_s{0.0};
  std::vector<std::string> deaths;  // "agv-3@20"
  bool tells_findings{false};
  bool tells_events{false};
};

lab::TrafficRunSettings settings_of(const Options& options, std::uint64_t seed) {
  lab::TrafficRunSettings settings;
  settings.seed = seed;
  settings.planner = options.planner;
  settings.restart_of_the_leader_s = options.leader_forgets_at_s;
  if (options.is_disturbed) settings.disturbance = lab::Disturbance::usual();

  for (const std::string& death : options.deaths) {
    const std::size_t at = death.find('@');
    settings.deaths.push_back({death.substr(0, at), std::stod(death.substr(at + 1))});
  }

  return settings;
}

void print_run(const scenario::Scenario& scenario, const lab::TrafficRun& run, std::uint64_t seed) {
  fmt::print(
      "{:<24} {:>4} {:>5}/{:<5} {:>7.1f} {:>6.1f} {:>6.2f} {:>4} {:>5} {:>5} {:>4} {:>4} {:>4} {:>6.1f} {:>6.1f} "
      "{:>6.1f} {:>6.1f}  {} {}\n",
      scenario.name, seed, run.goals, run.goals_wanted,
      run.goals == run.goals_wanted ? run.last_goal_s : run.duration_s,
      run.goals_per_vehicle_hour(scenario.vehicles.size()), run.own_way_share, run.contacts, run.wall_contacts,
      run.off_road, run.held_twice, run.refused, run.circles, run.standoff.seconds, run.wait.seconds, run.step_ms_p99,
      run.all_steps_s, run.standoff.seconds > 5.0 ? run.standoff.agv_id : run.wait.agv_id,
      run.standoff.seconds > 5.0 ? run.standoff.cause : run.wait.cause);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Scenarios of traffic with vehicles that follow their granted road exactly");
  app.add_option("scenario", options.files, "scenario files")->required()->check(CLI::ExistingFile);
  app.add_option("--seed", options.first_seed, "the first one");
  app.add_option("--seeds", options.seeds, "how many");
  app.add_flag("--disturbed", options.is_disturbed, "holds, slow vehicles, loss and delays");
  app.add_option("--planner", options.planner, "of the vehicles' own ways; none: all drive by the roadmap");
  app.add_option("--leader-forgets-at", options.leader_forgets_at_s, "seconds");
  app.add_option("--dies", options.deaths, "agv-3@20: stops for ever and is silent from second 20 on");
  app.add_flag("--findings", options.tells_findings, "what the judge of the floor found");
  app.add_flag("--events", options.tells_events, "what the coordinator says");
  CLI11_PARSE(app, argc, argv);

  fmt::print("{:<24} {:>4} {:>11} {:>7} {:>6} {:>6} {:>4} {:>5} {:>5} {:>4} {:>4} {:>4} {:>6} {:>6} {:>6} {:>6}\n",
             "scenario", "seed", "goals", "last_s", "/v/h", "own", "hits", "walls", "off", "2x", "ref", "circ", "stand",
             "wait", "ms_p99", "cpu_s");

  bool is_clean = true;
  for (const std::string& file : options.files) {
    const scenario::Scenario scenario = scenario::read_scenario(file);

    for (int i = 0; i < options.seeds; ++i) {
      const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(i);
      const lab::TrafficRun run = lab::KinematicSite(scenario, settings_of(options, seed)).run();
      print_run(scenario, run, seed);
      is_clean = is_clean && run.is_clean();

      if (options.tells_findings)
        for (const std::string& line : run.findings) fmt::print("    {}\n", line);
      if (options.tells_events)
        for (const std::string& line : run.events) fmt::print("    - {}\n", line);
    }
  }

  return is_clean ? 0 : 1;
}
