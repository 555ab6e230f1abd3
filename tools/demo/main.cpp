// aisle-demo: drives a scenario with all its processes on this machine, judged by the referee.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/signals.hpp"
#include "common/process/version.hpp"
#include "common/scenario/scenario.hpp"
#include "common/service/arguments.hpp"
#include "tools/demo/domain_lock.hpp"
#include "tools/demo/fleet.hpp"
#include "tools/demo/orders.hpp"
#include "tools/demo/supervisor.hpp"

namespace {

namespace fs = std::filesystem;

using namespace aisle;

/// The command line.
struct Options {
  std::string scenario{"warehouse"};
  std::optional<std::uint64_t> seed;
  std::string out;
  std::string config;
  std::optional<int> domain;
  std::vector<std::string> kills;
  std::vector<std::string> delays;
  std::optional<double> timeout_s;
  bool reversed{false};
  bool together{false};

  void add_to(CLI::App& app) {
    app.set_version_flag("--version", std::string("aisle-demo ") + process::software_version());
    app.add_option("SCENARIO", scenario, "name in deploy/scenarios, or a file")->capture_default_str();
    app.add_option("--seed", seed, "default: the scenario's");
    app.add_option("--out", out, "folder for the report, pictures and logs; default: out/<scenario>");
    app.add_option(
           "--config", config,
           "folder with the services' configuration, <service>.yaml; default: deploy/config of the scenario's tree")
        ->check(CLI::ExistingDirectory);
    app.add_option("--domain", domain, "DDS domain; default: a free one from 100 to 200")->check(CLI::Range(0, 230));
    app.add_option("--kill", kills,
                   "SERVICE@SECONDS[:RESTART_AFTER_S]: kill -9, then restart (after 1 s); may be repeated")
        ->take_all();
    app.add_option("--delay", delays, "SERVICE@SECONDS: starts only then; may be repeated")->take_all();
    app.add_option("--timeout", timeout_s, "seconds until the run is given up; default: the scenario's duration")
        ->check(CLI::Range(1.0, 86400.0));
    app.add_flag("--reversed", reversed, "start the processes in reverse order");
    app.add_flag("--together", together, "one process simulates all vehicles, and one drives them all");
  }
};

/// All programs lie in one folder.
fs::path program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

/// Makes the folders, and removes logs and kept state of an earlier run.
void prepare(const fs::path& out) {
  std::error_code error;
  fs::remove_all(out / "logs", error);
  fs::remove_all(out / "state", error);
  fs::create_directories(out / "logs", error);
  if (!error) fs::create_directories(out / "state", error);

  if (error)
    throw config::BadEnvironment(
        fmt::format("--out {}: {}; choose a folder that can be written", out.string(), error.message()));
}

/// The scenario's processes, some of them delayed by --delay. @throws config::BadInput for an order
/// that means none
std::vector<demo::Process> ordered_processes(const scenario::Scenario& scenario, const demo::RunSettings& settings,
                                             const Options& options) {
  std::vector<demo::Process> processes = demo::processes_of(scenario, settings);
  std::vector<std::string> instances;

  for (const demo::Process& process : processes) instances.push_back(process.instance);

  for (const std::string& text : options.delays) {
    const demo::DelayOrder order = demo::parse_delay(text);
    demo::require_known(order.service, instances);

    for (demo::Process& process : processes) {
      if (demo::means(order.service, process.instance)) process.start_s = order.until_s;
    }
  }

  for (const std::string& text : options.kills) demo::require_known(demo::parse_kill(text).service, instances);
  return processes;
}

/// processes.json, beside the referee's report.
void write_outcome(const demo::RunOutcome& outcome, const fs::path& out) {
  nlohmann::ordered_json deaths = nlohmann::ordered_json::array();
  for (const demo::Death& death : outcome.deaths) {
    deaths.push_back({{"instance", death.instance},
                      {"ending", death.ending},
                      {"while_stopping", death.while_stopping},
                      {"last_words", death.last_words}});
  }

  const nlohmann::ordered_json json{{"processes", outcome.processes},
                                    {"kills", outcome.kills},
                                    {"unexpected_deaths", outcome.unexpected_deaths},
                                    {"stopped_cleanly", outcome.stopped_cleanly},
                                    {"stopped_uncleanly", outcome.stopped_uncleanly},
                                    {"slowest_stop_s", outcome.slowest_stop_s},
                                    {"deaths", std::move(deaths)}};
  std::ofstream(out / "processes.json") << json.dump(2) << "\n";
}

/// @returns the referee's exit code
int drive(const Options& options) {
  demo::RunSettings settings;
  settings.scenario_file = demo::find_scenario(options.scenario, program_folder());

  const scenario::Scenario scenario = scenario::read_scenario(settings.scenario_file);
  const fs::path deploy = settings.scenario_file.parent_path().parent_path();

  // Places and limits: what is not given comes from the scenario's tree, or from the scenario.
  settings.config_folder = options.config.empty() ? deploy / "config" : fs::absolute(options.config);

  settings.out =
      fs::absolute(options.out.empty() ? fs::path("out") / settings.scenario_file.stem() : fs::path(options.out));

  settings.seed = options.seed.value_or(scenario.seed);
  settings.timeout_s = options.timeout_s.value_or(scenario.duration_s);
  settings.reversed = options.reversed;
  settings.together = options.together;

  std::vector<demo::KillOrder> kills;
  for (const std::string& text : options.kills) kills.push_back(demo::parse_kill(text));

  // A domain of its own, as long as the run lasts.
  const demo::DomainLock lock =
      options.domain ? demo::DomainLock::take(*options.domain) : demo::DomainLock::take_any(getpid());
  settings.domain = lock.domain();

  std::vector<demo::Process> processes = ordered_processes(scenario, settings, options);
  prepare(settings.out);

  demo::Progress progress(isatty(STDOUT_FILENO) == 1);
  progress.say(fmt::format("{}: {} vehicles, seed {}, {} processes on domain {}, logs in {}", scenario.name,
                           scenario.vehicles.size(), settings.seed, processes.size(), settings.domain,
                           (settings.out / "logs").string()));

  demo::Supervisor supervisor(std::move(processes), std::move(kills), program_folder(), settings.out / "logs",
                              progress);
  const demo::RunOutcome outcome = supervisor.run(process::stop_on_signals(), settings.timeout_s + 15.0);

  write_outcome(outcome, settings.out);

  progress.say(
      fmt::format("\n  {} of {} services stopped cleanly (slowest {:.2f} s), {} killed and {} died during the run",
                  outcome.stopped_cleanly, outcome.stopped_cleanly + outcome.stopped_uncleanly, outcome.slowest_stop_s,
                  outcome.kills, outcome.unexpected_deaths));
  progress.say(fmt::format("  report.json, fleet.svg, speeds.svg in {}", settings.out.string()));

  return outcome.referee_code;
}

}  // namespace

int main(int argc, char** argv) {
  return process::run_guarded("aisle-demo", [&]() -> int {
    process::stop_on_signals();

    Options options;
    CLI::App app("Drives a fleet through a scenario, all on this machine, and judges it.", "aisle-demo");

    options.add_to(app);
    if (const std::optional<int> code = service::parse_arguments(app, argc, argv)) return *code;

    return drive(options);
  });
}
