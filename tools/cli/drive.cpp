// aisle drive: a scenario in lock-step, without DDS, with the services' own cores from scan to motion.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/own_usage.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/drive_picture.hpp"
#include "tools/cli/json/json.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/planning/output_file.hpp"
#include "tools/lockstep/families.hpp"
#include "tools/lockstep/totals.hpp"

namespace aisle::cli {
namespace {

struct Options {
  std::string scenario;
  std::string local{"wang"};
  std::string global{"direct"};
  int seed{1};
  int runs{1};
  std::string svg;
  std::string only_scans_of;
  bool truth{false};
  bool paper_limits{false};
  bool verbose{false};
};

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void check_name(const char* flag, const std::string& name, const std::vector<std::string>& known) {
  for (const std::string& candidate : known)
    if (candidate == name) return;
  const std::string nearest = config::nearest_name(name, known);
  throw config::BadInput(fmt::format("{}: '{}' is unknown; {}there are {}", flag, name,
                                     nearest.empty() ? "" : "did you mean '" + nearest + "'? ", listed(known)));
}

template <class Variant>
std::vector<std::string> names_of(const std::vector<Variant>& variants) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  return names;
}

/// `id` as it is. @throws config::BadInput when it is neither empty nor a vehicle of the scenario
std::string known_vehicle(const std::string& id, const scenario::Scenario& scenario) {
  std::vector<std::string> ids;
  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);
  if (!id.empty()) check_name("--only-scans-of", id, ids);
  return id;
}

lockstep::Setup setup_of(const Options& options, int run) {
  lockstep::Setup setup = lockstep::named_setup(
      options.scenario, static_cast<std::uint64_t>(options.seed) + static_cast<std::uint64_t>(run));
  setup.local = options.local;
  setup.planner = options.global;
  setup.paper_limits = options.paper_limits;
  setup.only_scans_of = known_vehicle(options.only_scans_of, setup.scenario);
  if (options.truth) setup.perception = lockstep::Perception::kTruth;
  return setup;
}

void print(const Cli& cli, const Options& options, const lockstep::Totals& totals, double realtime_factor) {
  const std::string hash = fmt::format("{:016x}", totals.trace_hash);
  const bool has_least = totals.least_clearance_m < lockstep::kNothingNearM;
  if (cli.json) {
    std::printf("%s\n",
                write_json(Json{{"local", options.local},
                                {"global", options.global},
                                {"runs", totals.runs},
                                {"goals_assigned", totals.goals_assigned},
                                {"goals_reached", totals.goals_reached},
                                {"contacts", totals.contacts},
                                {"contacts_moving_vehicle", totals.contacts_moving_vehicle},
                                {"least_clearance_m", has_least ? Json(totals.least_clearance_m) : Json(nullptr)},
                                {"distance_m", totals.distance_m},
                                {"time_s", totals.time_s},
                                {"replans", totals.replans},
                                {"omega_sign_changes", totals.omega_sign_changes},
                                {"jerk_rms", totals.jerk_rms},
                                {"realtime_factor", realtime_factor},
                                {"trace_hash", hash}})
                    .c_str());
    return;
  }
  std::printf("%d run%s, global %s, local %s\n", totals.runs, totals.runs == 1 ? "" : "s", options.global.c_str(),
              options.local.c_str());
  std::printf("goals %d of %d, contacts %d (%d of a moving vehicle), least clearance %s\n", totals.goals_reached,
              totals.goals_assigned, totals.contacts, totals.contacts_moving_vehicle,
              has_least ? fmt::format("{:.3f} m", totals.least_clearance_m).c_str() : "-, as nothing came near");
  std::printf("%.1f m in %.1f s, %d replans, %d changes of the turn's sign, jerk %.2f m/s^3\n", totals.distance_m,
              totals.time_s, totals.replans, totals.omega_sign_changes, totals.jerk_rms);
  std::printf("%.0f x real time by CPU time, trace %s\n", realtime_factor, hash.c_str());
}

struct Driven {
  lockstep::Totals totals;
  double took_s{0.0};  // of this process's CPU time: what else the machine does is no matter
};

/// One run, with its picture where one is asked for. @returns false when the user stopped it
bool drive_once(const Options& options, int run, ProgressLine& progress, Driven& driven) {
  const lockstep::Setup setup = setup_of(options, run);
  DrivePicture picture(setup);
  const bool draws = !options.svg.empty() && run == 0;
  const std::chrono::nanoseconds begun = process::cpu_time();
  const lockstep::Result result = lockstep::run(setup, draws ? picture.watch() : lockstep::Watch{}, [&](double t_s) {
    progress.tell(fmt::format("run {} of {}: {:.0f} s of at most {:.0f} s simulated", run + 1, options.runs, t_s,
                              setup.scenario.duration_s));
    return !is_interrupted();
  });
  if (is_interrupted()) return false;
  driven.took_s += Seconds(process::cpu_time() - begun).count();
  driven.totals.add(result);
  progress.clear();
  if (draws) write_output_file(options.svg, picture.svg(result));
  for (const std::string& line : result.log)
    if (options.verbose || lockstep::is_verdict(line))
      std::fprintf(stderr, "%s%s\n", options.runs > 1 ? fmt::format("seed {}: ", setup.seed).c_str() : "",
                   printable(line).c_str());
  return true;
}

int drive(const Cli& cli, const Options& options) {
  check_name("--local", options.local, names_of(local_planner::all_variants()));
  check_name("--global", options.global, names_of(global_planner::all_variants()));
  if (options.scenario.empty())
    throw config::BadInput("--scenario is missing: a scenario file, or one of " + listed(lockstep::families()));
  if (!options.svg.empty()) check_writable(options.svg);
  Driven driven;
  ProgressLine progress;
  bool goes_on = true;
  for (int run = 0; run < options.runs && goes_on; ++run) goes_on = drive_once(options, run, progress, driven);
  progress.clear();
  if (!goes_on) std::fprintf(stderr, "aisle drive: stopped after %d of %d runs\n", driven.totals.runs, options.runs);
  print(cli, options, driven.totals, driven.took_s > 0.0 ? driven.totals.time_s / driven.took_s : 0.0);
  return goes_on && driven.totals.is_good() ? process::kDone : process::kNegative;
}

}  // namespace

void add_drive(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<Options>();
  Verb(parent, cli, "drive",
       "drive a scenario in lock-step, without DDS; exit code 1 when a goal was missed or a moving vehicle touched "
       "something")
      .option("--scenario", options->scenario, "a scenario file, or one of " + listed(lockstep::families()))
      .option("--local", options->local,
              "local planner: " + local_planner::variant_names() + "; default: " + options->local)
      .option("--global", options->global,
              "global planner: " + listed(names_of(global_planner::all_variants())) + "; default: " + options->global)
      .option("--seed", options->seed, 0, 1'000'000'000, "of the first run; the next one has the next seed")
      .option("--runs", options->runs, 1, 100'000, "how many")
      .option("--svg", options->svg, "file for a picture of the first run")
      .option("--only-scans-of", options->only_scans_of,
              "the one vehicle whose scans the obstacle tracker takes; default: all")
      .flag("--truth", options->truth, "tracks from the truth in sight, not from simulated scans")
      .flag("--paper-limits", options->paper_limits, "vehicles as in the local planner's paper")
      .flag("--verbose", options->verbose, "what happened, on stderr")
      .runs([&cli, options] { return drive(cli, *options); });
}

}  // namespace aisle::cli
