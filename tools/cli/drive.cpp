// aisle drive: a scenario with all its services on a simulated network, in virtual time and without DDS.

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "common/process/own_usage.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/known_names.hpp"
#include "tools/cli/lab_options.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/driving/map_drive.hpp"
#include "tools/lab/driving/printed_drive.hpp"
#include "tools/lab/results/provenance.hpp"
#include "tools/lab/results/result_text.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/referee/core/walls.hpp"
#include "tools/referee/report/fleet_svg.hpp"
#include "tools/referee/report/report_json.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"
#include "tools/sim/totals.hpp"

namespace aisle::cli {
namespace {

/// The flags with their defaults.
struct Options {
  std::string scenario;
  std::string local{"wang"};
  std::string global;  // empty: `direct`, or as printed that of the local planner's paper
  MapFlags map;
  ParameterFlags parameters;
  double radius_m{-1.0};  // of the vehicle on --map; below 0: not given
  std::string csv, jsonl;
  bool as_printed{false};
  int seed{1};
  int runs{1};
  std::string svg;
  std::string only_scans_of;
  std::string faults;
  int fault_seed{0};
  bool truth{false};
  bool paper_limits{false};
  bool verbose{false};
  double trace_s{0.0};  // 0: no trace

  double vehicle_radius_m() const { return radius_m < 0.0 ? 0.35 : radius_m; }
  bool writes_rows() const { return !csv.empty() || !jsonl.empty(); }
};

/// `id` as it is. @throws config::BadInput when it is neither empty nor a vehicle of the scenario
std::string known_vehicle(const std::string& id, const scenario::Scenario& scenario) {
  std::vector<std::string> ids;
  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);
  if (!id.empty()) check_name("--only-scans-of", id, ids);
  return id;
}

/// What is driven in each run: read once, as maps may be large.
struct Course {
  std::optional<lab::Subject> subject;      // with --map
  std::vector<lab::ParameterValue> values;  // of the parameters that are set

  /// Each scenario of --scen is driven in each run.
  int queries() const { return subject ? static_cast<int>(subject->queries.size()) : 1; }
};

Course course_of(const Options& options) {
  Course course;
  course.values =
      parameters_of(options.parameters, {{options.global}, {options.local}, options.paper_limits, options.as_printed});
  if (!options.map.map.empty()) course.subject = lab::read_subject(subject_orders_of(options.map));
  return course;
}

/// Over the researcher's own map: as the paper prints it, or our own drive.
sim::Setup setup_on_map(const Options& options, const Course& course, const lab::Query& query) {
  const lab::Subject& subject = *course.subject;
  if (!options.as_printed) return lab::map_setup(options.map.map, subject, query, options.vehicle_radius_m());

  const local_planner::Variant variant = lab::local_variant(course.values, options.local);
  lab::check_ends(options.map.map, subject.grid, query, variant.printed.radius_m);
  return lab::printed_setup({subject.grid, query.start_in_map, query.goal_in_map}, variant, options.global,
                            subject.start_yaw_rad);
}

/// One run, with what the flags change.
sim::Setup setup_of(const Options& options, const Course& course, int run) {
  const std::uint64_t seed =
      static_cast<std::uint64_t>(options.seed) + static_cast<std::uint64_t>(run / course.queries());
  sim::Setup setup =
      course.subject
          ? setup_on_map(options, course, course.subject->queries[static_cast<std::size_t>(run % course.queries())])
          : sim::named_setup(options.scenario, seed);

  setup.seed = seed;
  setup.local = options.local;
  setup.planner = options.global;
  if (!course.values.empty()) setup.own_variant = lab::local_variant(course.values, options.local);
  setup.planner_parameters = lab::global_parameters(course.values, options.global);
  lab::set_settings(course.values, setup.fleet, setup.settings);
  if (options.as_printed) return setup;

  setup.paper_limits = options.paper_limits;
  setup.only_scans_of = known_vehicle(options.only_scans_of, setup.scenario);
  if (options.truth) setup.perception = sim::Perception::kTruth;

  return setup;
}

/// What several runs gave.
struct Driven {
  sim::Totals totals;
  double took_s{0.0};  // of this process's CPU time: what else the machine does is no matter
  std::map<std::string, std::uint64_t> faults;
  Json goals_failed = Json::array();
  Json violations = Json::array();
  std::vector<lab::Row> rows;  // where a file of them is asked for

  void add(const sim::Outcome& outcome) {
    totals.add(outcome.result);
    for (const auto& [kind, count] : outcome.faults) faults[kind] += count;

    const Json report = referee::to_json(outcome.report);
    for (const Json& goal : report.at("goals_failed")) goals_failed.push_back(goal);
    for (const Json& violation : report.at("authority_violation_list")) violations.push_back(violation);
  }

  bool is_good() const { return totals.is_good() && violations.empty(); }

  double realtime_factor() const { return took_s > 0.0 ? totals.time_s / took_s : 0.0; }
  std::string trace_hash() const { return fmt::format("{:016x}", totals.trace_hash); }
};

Json json_or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(nullptr); }

/// One JSON object.
void print_json(const Options& options, const Driven& driven) {
  const sim::Totals& totals = driven.totals;
  const bool has_least = totals.least_clearance_m < sim::kNothingNearM;

  std::printf("%s\n", write_json(Json{{"local", options.local},
                                      {"global", options.global},
                                      {"runs", totals.runs},
                                      {"goals_assigned", totals.goals_assigned},
                                      {"goals_reached", totals.goals_reached},
                                      {"contacts", totals.contacts},
                                      {"contacts_moving_vehicle", totals.contacts_moving_vehicle},
                                      {"least_clearance_m", has_least ? Json(totals.least_clearance_m) : Json(nullptr)},
                                      {"distance_m", totals.distance_m},
                                      {"time_s", totals.time_s},
                                      {"longest_standoff_s", totals.longest_standoff_s},
                                      {"longest_standoff", totals.longest_standoff},
                                      {"longest_wait_s", totals.longest_wait_s},
                                      {"longest_wait", totals.longest_wait},
                                      {"goals_per_vehicle_hour", json_or_null(totals.goals_per_vehicle_hour())},
                                      {"own_way_share", json_or_null(totals.own_way_share())},
                                      {"replans", totals.replans},
                                      {"omega_sign_changes", totals.omega_sign_changes},
                                      {"jerk_rms", totals.jerk_rms},
                                      {"realtime_factor", driven.realtime_factor()},
                                      {"trace_hash", driven.trace_hash()},
                                      {"faults", driven.faults},
                                      {"goals_failed", driven.goals_failed},
                                      {"violations", driven.violations}})
                          .c_str());
}

/// A few lines for a person.
void print_text(const Options& options, const Driven& driven) {
  const sim::Totals& totals = driven.totals;
  const bool has_least = totals.least_clearance_m < sim::kNothingNearM;

  std::printf("%d run%s, global %s, local %s\n", totals.runs, totals.runs == 1 ? "" : "s", options.global.c_str(),
              options.local.c_str());
  std::printf("goals %d of %d, contacts %d (%d of a moving vehicle), least clearance %s\n", totals.goals_reached,
              totals.goals_assigned, totals.contacts, totals.contacts_moving_vehicle,
              has_least ? fmt::format("{:.3f} m", totals.least_clearance_m).c_str() : "-, as nothing came near");
  std::printf("%.1f m in %.1f s, %d replans, %d changes of the turn's sign, jerk %.2f m/s^3\n", totals.distance_m,
              totals.time_s, totals.replans, totals.omega_sign_changes, totals.jerk_rms);

  if (totals.longest_wait_s > 0.0)
    std::printf("longest wait %.1f s: %s\n", totals.longest_wait_s, totals.longest_wait.c_str());
  if (totals.longest_standoff_s > 0.0)
    std::printf("longest stand-off %.1f s: %s\n", totals.longest_standoff_s, totals.longest_standoff.c_str());
  if (const auto rate = totals.goals_per_vehicle_hour())
    std::printf("%.0f goals a vehicle and hour, %.0f %% of the metres on own ways\n", *rate,
                100.0 * totals.own_way_share().value_or(0.0));

  std::string faults;
  for (const auto& [kind, count] : driven.faults)
    faults += fmt::format("{}{} {}", faults.empty() ? "" : ", ", kind, count);

  if (!faults.empty()) std::printf("faults: %s\n", faults.c_str());
  if (!driven.violations.empty()) std::printf("violations of authority: %zu\n", driven.violations.size());
  std::printf("%.0f x real time by CPU time, trace %s\n", driven.realtime_factor(), driven.trace_hash().c_str());
}

/// Of --faults or --fault-seed. The run's own seed draws which processes and packets are hit.
sim::Faults faults_of(const Options& options, std::uint64_t seed) {
  if (!options.faults.empty() && options.fault_seed > 0)
    throw config::BadInput("--faults and --fault-seed name two fault plans: give one of them");
  if (!options.faults.empty()) return {sim::read_fault_plan(options.faults), seed};
  if (options.fault_seed > 0) return {sim::random_fault_plan(static_cast<std::uint64_t>(options.fault_seed)), seed};
  return {};
}

/// Poses, commands, things and tracks, as lines of one moment.
std::string text_of(const sim::Snapshot& now, const scenario::Scenario& scenario) {
  std::string text;
  for (std::size_t i = 0; i < now.outputs.size(); ++i) {
    const geometry::Pose2& base = now.vehicles_in_map[i];
    const local_planner::Output& output = now.outputs[i];
    text += fmt::format("{:8.2f} {} ({:.2f} {:.2f} {:.2f}) v {:.2f} w {:.2f} left {:.2f} {}/{} {}\n", now.t_s,
                        scenario.vehicles[i].id, base.x, base.y, base.yaw, output.twist.linear_mps,
                        output.twist.angular_radps, output.distance_left_m, name(output.phase), name(output.reason),
                        printable(output.detail));
  }

  for (const geometry::Body& thing : now.things)
    text += fmt::format("{:8.2f} thing ({:.2f} {:.2f})\n", now.t_s, thing.base_in_map.x, thing.base_in_map.y);
  for (const fleet::Track& track : now.tracks)
    text += fmt::format("{:8.2f} track {} ({:.2f} {:.2f}) v ({:.2f} {:.2f}) r {:.2f}{}\n", now.t_s, track.id,
                        track.position_in_map.x, track.position_in_map.y, track.velocity_in_map.x,
                        track.velocity_in_map.y, track.radius_m, track.is_static ? " static" : "");
  return text;
}

/// Prints on stderr what can be seen, every `period_s`.
sim::Watch tracer(const scenario::Scenario& scenario, double period_s, ProgressLine& progress) {
  constexpr double kHalfLookS = 0.05;  // looks come every 0.1 s, give or take rounding
  return [&scenario, &progress, period_s, next_s = 0.0](const sim::Snapshot& now) mutable {
    if (now.t_s < next_s - kHalfLookS) return;
    next_s = now.t_s + period_s;
    progress.clear();
    std::fputs(text_of(now, scenario).c_str(), stderr);
  };
}

/// One run, with its picture where one is asked for. @returns false when the user stopped it
bool drive_once(const Options& options, const Course& course, int run, ProgressLine& progress, Driven& driven) {
  const sim::Setup setup = setup_of(options, course, run);
  const sim::Faults faults = faults_of(options, setup.seed);
  const int runs = options.runs * course.queries();
  const std::string prefix = runs > 1 ? fmt::format("seed {}: ", setup.seed) : "";

  const auto say = [&](const std::string& line) {
    progress.clear();
    std::fprintf(stderr, "%s%s\n", prefix.c_str(), printable(line).c_str());
  };

  sim::Hooks hooks;
  hooks.goes_on = [&](double t_s) {
    progress.tell(fmt::format("run {} of {}: {:.0f} s of at most {:.0f} s simulated", run + 1, runs, t_s,
                              setup.scenario.duration_s));
    return !is_interrupted();
  };
  if (options.verbose) hooks.says = say;
  if (options.trace_s > 0.0) hooks.watch = tracer(setup.scenario, options.trace_s, progress);

  lab::DriveRows rows(setup, static_cast<std::size_t>(run % course.queries()));
  if (options.writes_rows()) hooks.on_cycle = [&rows](const sim::Cycle& cycle) { rows.take(cycle); };

  const std::chrono::nanoseconds begun = process::cpu_time();
  const sim::Outcome outcome = sim::drive(setup, faults, hooks);

  if (is_interrupted()) return false;

  driven.took_s += Seconds(process::cpu_time() - begun).count();
  driven.add(outcome);
  driven.rows.insert(driven.rows.end(), rows.rows().begin(), rows.rows().end());
  progress.clear();

  if (!options.svg.empty() && run == 0)
    process::write_output_file(options.svg,
                               referee::fleet_svg(outcome.report, referee::Walls(setup.grid), setup.scenario.zones));

  for (const std::string& line : outcome.result.log) say(line);

  // A plan from a seed that did harm is printed, to be run again from a file.
  const bool is_good = outcome.report.goals_missed() == 0 && outcome.report.contacts_moving_vehicle() == 0 &&
                       outcome.report.violations.empty();
  if (options.fault_seed > 0 && (options.verbose || !is_good))
    std::fprintf(stderr, "# --seed %llu --fault-seed %d is --seed %llu --faults with this file:\n%s",
                 static_cast<unsigned long long>(setup.seed), options.fault_seed,
                 static_cast<unsigned long long>(setup.seed), sim::to_yaml(faults.plan).c_str());

  return true;
}

/// What is driven: a scenario, or a map.
void check_subject(const Options& options) {
  const bool has_map = !options.map.map.empty();
  if (options.as_printed && !has_map)
    throw config::BadInput("--as-printed needs --map FILE: a paper's map with S and T, or your own");
  if (has_map && !options.scenario.empty())
    throw config::BadInput("--map drives one vehicle over a map, and --scenario is another drive: give one of them");
  if (!has_map && options.scenario.empty())
    throw config::BadInput("--scenario is missing: a scenario file, or one of " + listed(sim::families()) +
                           "; or give your own --map");

  const Typed radius{"--radius", options.radius_m >= 0.0};
  if (!has_map) {
    refuse_typed(typed_place_flags(options.map), "counts with --map only: --scenario has its own");
    refuse_typed({radius}, "counts with --map only: --scenario has its own");
  }
  if (options.as_printed)
    refuse_typed({radius,
                  {"--truth", options.truth},
                  {"--only-scans-of", !options.only_scans_of.empty()},
                  {"--paper-limits", options.paper_limits}},
                 "does not count with --as-printed, where the paper decides it");
}

/// All flags are checked before the first run, which may take minutes.
void check_files(const Options& options) {
  for (const std::string& file : {options.svg, options.csv, options.jsonl})
    if (!file.empty()) process::check_writable(file);
}

void write_rows(const Options& options, const Course& course, const std::vector<lab::Row>& rows) {
  if (!options.writes_rows()) return;

  const bool has_radius = !options.map.map.empty() && !options.as_printed;
  lab::Row particular{{"subject", options.map.map + options.scenario},
                      {"global", options.global},
                      {"local", options.local},
                      {"as_printed", options.as_printed},
                      {"paper_limits", options.paper_limits},
                      {"seed", options.seed},
                      {"runs", options.runs},
                      {"parameters", listed_values(course.values)},
                      {"radius_m", has_radius ? lab::Row(options.vehicle_radius_m()) : lab::Row(nullptr)}};
  particular.update(head_rows(options.map));

  const lab::Row head = lab::head_of("aisle drive", lab::provenance(), particular);
  if (!options.csv.empty()) process::write_output_file(options.csv, lab::csv_text(head, rows));
  if (!options.jsonl.empty()) process::write_output_file(options.jsonl, lab::jsonl_text(head, rows));
}

/// With the global planner named.
Options completed(Options options) {
  check_name("--local", options.local, names_of(local_planner::all_variants()));
  if (options.global.empty())
    options.global =
        options.as_printed ? lab::global_planner_of(*local_planner::find_variant(options.local)) : "direct";
  check_name("--global", options.global, names_of(global_planner::all_variants()));
  return options;
}

int drive(const Cli& cli, const Options& given) {
  const Options options = completed(given);
  check_subject(options);
  check_files(options);
  const Course course = course_of(options);

  Driven driven;
  ProgressLine progress;
  bool goes_on = true;

  const int runs = options.runs * course.queries();
  for (int run = 0; run < runs && goes_on; ++run) goes_on = drive_once(options, course, run, progress, driven);
  progress.clear();
  if (!goes_on) std::fprintf(stderr, "aisle drive: stopped after %d of %d runs\n", driven.totals.runs, runs);
  write_rows(options, course, driven.rows);
  if (cli.json)
    print_json(options, driven);
  else
    print_text(options, driven);

  return goes_on && driven.is_good() ? process::kDone : process::kNegative;
}

}  // namespace

void add_drive(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<Options>();
  Verb verb(parent, cli, "drive",
            "drive a scenario, or over your own map, with all services on a simulated network, without DDS; exit code "
            "1 when a goal was missed, a moving vehicle touched something, or a vehicle obeyed a command that it "
            "should not have");
  add_map_flags(verb, options->map);
  add_parameter_flags(verb, options->parameters);
  verb.option("--scenario", options->scenario, "a scenario file, or one of " + listed(sim::families()))
      .option("--local", options->local,
              "local planner: " + local_planner::variant_names() + "; default: " + options->local)
      .option("--global", options->global,
              "global planner: " + listed(names_of(global_planner::all_variants())) +
                  "; default: direct, as printed that of the same paper")
      .option("--radius", options->radius_m, 0.01, 100.0, "m, of the vehicle on --map; default: 0.35")
      .flag("--as-printed", options->as_printed,
            "the local planner as its paper prints it on --map, with nothing of ours in between")
      .option("--seed", options->seed, 0, 1'000'000'000, "of the first run; the next one has the next seed")
      .option("--runs", options->runs, 1, 100'000, "how many")
      .option("--csv", options->csv,
              "write each cycle here as CSV: pose, v, w, clearance, compute time; and the plans' waypoints")
      .option("--jsonl", options->jsonl, "the same as JSON Lines")
      .option("--svg", options->svg, "file for a picture of the first run")
      .option("--only-scans-of", options->only_scans_of,
              "the one vehicle whose scans the obstacle tracker takes; default: all")
      .option("--faults", options->faults, "file that says what goes wrong, e.g. deploy/faults/loss.yaml")
      .option("--fault-seed", options->fault_seed, 1, 1'000'000'000,
              "makes such a plan up, the same for the same number")
      .option("--trace", options->trace_s, 0.0, 3600.0,
              "s; so often poses, commands, things and tracks are printed on stderr; 0: never")
      .flag("--truth", options->truth, "tracks from the truth in sight, not from simulated scans")
      .flag("--paper-limits", options->paper_limits, "vehicles as in the local planner's paper")
      .flag("--verbose", options->verbose, "what happened, on stderr")
      .runs([&cli, options] { return drive(cli, *options); });
}

}  // namespace aisle::cli
