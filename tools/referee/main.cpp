// aisle-referee: judges one simulated run, writes its report and pictures, and says by its exit code whether it went
// well.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "common/process/exit_code.hpp"
#include "common/process/signals.hpp"
#include "common/scenario/scenario.hpp"
#include "common/service/run_service.hpp"
#include "tools/referee/referee_service.hpp"
#include "tools/referee/report/summary.hpp"
#include "tools/referee/report/write_report.hpp"

namespace {

using namespace aisle;

/// The command line.
struct Options {
  std::string scenario_file;
  std::optional<std::uint64_t> seed;
  std::string out{"out"};
  std::optional<double> duration_s;
  bool progress_json{false};

  void add_to(CLI::App& app) {
    app.add_option("--scenario", scenario_file, "scenario file that is run")->required();
    app.add_option("--seed", seed, "for the report; default: the scenario's");
    app.add_option("--out", out, "folder for report.json, fleet.svg and speeds.svg")->capture_default_str();
    app.add_option("--duration", duration_s, "seconds until it gives up; default: the scenario's")
        ->check(CLI::PositiveNumber);
    app.add_flag("--progress-json", progress_json, "one JSON line a second on stdout");
  }
};

/// Each vehicle's goals, loops counted.
referee::Expectation expectation_of(const scenario::Scenario& scenario) {
  referee::Expectation expectation;
  for (const scenario::Mission& mission : scenario.missions) {
    expectation.goals_of[mission.vehicle] += static_cast<int>(mission.goals_in_map.size()) * mission.loops;
  }

  expectation.goals_of_any = scenario.goal_count() - expectation.goals();
  return expectation;
}

/// The line of --progress-json, which `aisle-demo` reads.
void print_progress(const referee::RefereeService& service, int goals_expected) {
  const referee::Judge& judge = service.judge();
  fmt::print(
      "{{\"t_s\":{:.1f},\"goals_reached\":{},\"goals_assigned\":{},\"goals_expected\":{},\"contacts\":{},\"vehicles\":{"
      "}}}\n",
      service.now_s(), judge.goals().count(referee::GoalOutcome::kReached), judge.goals().assigned_count(),
      goals_expected, judge.contacts().contacts().size(), judge.vehicles_seen());

  std::fflush(stdout);
}

/// Runs until the missions are over, time is up or a signal comes; returns the report.
referee::RunReport judge_run(service::Shell& shell, const scenario::Scenario& scenario, const referee::Walls& walls,
                             const Options& options) {
  const referee::Expectation expectation = expectation_of(scenario);
  referee::RefereeService service(shell, walls, expectation);

  if (options.progress_json) {
    shell.bus().every(std::chrono::seconds(1), [&] { print_progress(service, expectation.goals()); });
  }

  // Until there is a reason to stop.
  const double duration_s = options.duration_s.value_or(scenario.duration_s);
  std::string because;

  while (because.empty()) {
    shell.bus().run_once(std::chrono::milliseconds(50));
    shell.publish_changes();
    if (service.is_over()) because = "all missions are over";
    if (service.now_s() >= duration_s) because = fmt::format("{:.0f} s are over", duration_s);
    if (process::stop_on_signals()) because = "stopped by a signal";
  }

  referee::RunReport report = service.finish();
  report.ended_because = because;
  report.scenario = scenario.name;
  report.seed = options.seed.value_or(scenario.seed);
  report.person_clearance_m = scenario.person_clearance_m;
  report.people_give_way = scenario.recordings.empty();

  return report;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  int verdict = process::kDone;
  const service::About about{
      "referee", "Judges a simulated run from ground truth: contacts, clearance, goals, authority, timing.", ""};

  const int code = service::run_process(
      argc, argv, about, [&](CLI::App& app) { options.add_to(app); },
      [&](service::Process& process) {
        const scenario::Scenario scenario = scenario::read_scenario(options.scenario_file);
        const referee::Walls walls(grid::read_map_file(scenario.map_file, scenario.map_options));
        const referee::RunReport report = judge_run(process.shell(), scenario, walls, options);

        referee::write_report(report, walls, options.out, scenario.zones);
        fmt::print("{}", referee::summary(report));
        verdict = report.passed() ? process::kDone : process::kNegative;
      });

  return code != process::kDone ? code : verdict;
}
