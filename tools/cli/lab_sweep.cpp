// aisle lab sweep: a grid of parameters, planners, maps and seeds, planned or driven.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/process/exit_code.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/known_names.hpp"
#include "tools/cli/lab_options.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/results/provenance.hpp"
#include "tools/lab/results/result_text.hpp"
#include "tools/lab/sweep/run_sweep.hpp"
#include "tools/lab/sweep/sweep.hpp"
#include "tools/lab/sweep/sweep_folder.hpp"
#include "tools/lab/sweep/trial_runner.hpp"

namespace aisle::cli {
namespace {

constexpr std::size_t kMostShown = 50;  // rows of the table that a person reads

/// As typed. Lists are added to those of --config, but --local and --seeds replace them, as numbers do.
struct SweepFlags {
  std::string config, seeds, out;
  std::vector<std::string> maps, kinds, scenarios, planners, locals, vary;
  MapFlags map;  // for its resolution, start, goal, scen and limit
  ParameterFlags parameters;
  double radius_m{-1.0}, safe_distance_m{-1.0}, vehicle_radius_m{-1.0};  // below 0: not given
  bool drives{false}, as_printed{false}, paper_limits{false};
  int workers{2};
};

void add(const std::vector<std::string>& names, std::vector<std::string>& to) {
  to.insert(to.end(), names.begin(), names.end());
}

/// "all" stands for every planner.
std::vector<std::string> with_all(const std::vector<std::string>& names, const std::vector<std::string>& all) {
  return names == std::vector<std::string>{"all"} ? all : names;
}

void take_numbers(const SweepFlags& flags, lab::Sweep& sweep) {
  if (flags.radius_m >= 0.0) sweep.radius_m = flags.radius_m;
  if (flags.safe_distance_m >= 0.0) sweep.safe_distance_m = flags.safe_distance_m;
  if (flags.vehicle_radius_m >= 0.0) sweep.vehicle_radius_m = flags.vehicle_radius_m;
  if (!flags.seeds.empty()) sweep.seeds = lab::parse_seeds("--seeds", flags.seeds);
}

/// Flags that would not count in this sweep.
void check_typed(const SweepFlags& flags, const lab::Sweep& sweep) {
  if (flags.maps.empty()) refuse_typed(typed_place_flags(flags.map), "counts with --map only");
  if (!sweep.drives) {
    refuse_typed({{"--local", !flags.locals.empty()}, {"--vehicle-radius", flags.vehicle_radius_m >= 0.0}},
                 "counts with --drive only");
  } else {
    refuse_typed({{"--radius", flags.radius_m >= 0.0}, {"--safe-distance", flags.safe_distance_m >= 0.0}},
                 "is of paths, and this sweep drives: see --vehicle-radius");
  }

  if (sweep.as_printed)
    refuse_typed({{"--vehicle-radius", flags.vehicle_radius_m >= 0.0}, {"--paper-limits", flags.paper_limits}},
                 "does not count with --as-printed, where the paper decides it");
}

/// The sweep of the file, with what the flags add.
lab::Sweep sweep_of(const SweepFlags& flags) {
  lab::Sweep sweep = flags.config.empty() ? lab::Sweep{} : lab::read_sweep(flags.config);
  sweep.drives = sweep.drives || flags.drives;
  sweep.as_printed = sweep.as_printed || flags.as_printed;
  sweep.paper_limits = sweep.paper_limits || flags.paper_limits;
  check_typed(flags, sweep);
  take_numbers(flags, sweep);

  for (const std::string& map : flags.maps) {
    MapFlags one = flags.map;
    one.map = map;
    sweep.maps.push_back(subject_orders_of(one));
  }
  add(flags.kinds, sweep.kinds);
  add(flags.scenarios, sweep.scenarios);
  add(flags.planners, sweep.planners);
  sweep.planners = with_all(sweep.planners, names_of(global_planner::all_variants()));
  if (!flags.locals.empty()) sweep.locals = flags.locals;
  sweep.locals = with_all(sweep.locals, names_of(local_planner::all_variants()));

  const std::optional<lab::Side> only = sweep.drives ? std::nullopt : std::optional(lab::Side::kGlobal);
  const lab::InUse in_use{sweep.planners, sweep.drives ? sweep.locals : std::vector<std::string>{}, sweep.paper_limits,
                          sweep.as_printed};
  for (const lab::ParameterValue& value : parameters_of(flags.parameters, in_use, only)) sweep.set.push_back(value);
  for (const std::string& text : flags.vary) sweep.vary.push_back(lab::parse_variation("--vary", text, only));

  return sweep;
}

/// "hall.png, resolution 0.05, start 1,1, goal 9,7; ...", as they were given.
std::string listed_maps(const std::vector<lab::SubjectOrders>& maps) {
  const auto place = [](const char* what, const std::optional<lab::Place>& it) {
    if (!it) return std::string();
    const std::string yaw = it->yaw_rad ? fmt::format(",{}", *it->yaw_rad) : "";
    return fmt::format(", {} {},{}{}", what, it->in_map.x, it->in_map.y, yaw);
  };

  std::string text;
  for (const lab::SubjectOrders& map : maps) {
    text += (text.empty() ? "" : "; ") + map.map.string();
    if (map.cell_m > 0.0) text += fmt::format(", resolution {}", map.cell_m);
    text += place("start", map.start) + place("goal", map.goal);
    if (!map.scen.empty()) text += ", scen " + map.scen.string();
  }
  return text;
}

lab::Row head_of(const lab::Sweep& sweep, const lab::TrialRunner& runner, const std::vector<lab::Trial>& trials) {
  std::string seeds;
  for (const std::uint64_t seed : sweep.seeds) seeds += (seeds.empty() ? "" : ",") + std::to_string(seed);

  return lab::head_of("aisle lab sweep", lab::provenance(),
                      {{"sweep", runner.fingerprint(trials)},
                       {"trials", trials.size()},
                       {"maps", listed_maps(sweep.maps)},
                       {"drive", sweep.drives},
                       {"as_printed", sweep.as_printed},
                       {"paper_limits", sweep.paper_limits},
                       {"radius_m", sweep.drives ? sweep.vehicle_radius_m : sweep.radius_m},
                       {"safe_distance_m", sweep.safe_distance_m},
                       {"seeds", seeds},
                       {"parameters", listed_values(sweep.set)}});
}

std::string shown(const lab::Row& value) {
  if (value.is_null()) return "-";
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// The first rows as a person reads them.
std::string text_of(const std::vector<lab::Row>& rows) {
  const std::vector<std::string> columns = lab::columns_of(rows);
  std::vector<std::vector<std::string>> table{columns};
  for (std::size_t i = 0; i < rows.size() && i < kMostShown; ++i) {
    table.emplace_back();
    for (const std::string& column : columns) table.back().push_back(shown(rows[i].value(column, lab::Row())));
  }

  const std::string rest = rows.size() > kMostShown ? fmt::format("... {} rows in all\n", rows.size()) : "";
  return text_of_table(table) + rest;
}

/// On stderr, that trials could not be run.
void tell_refusals(const std::vector<lab::Row>& rows) {
  const auto is_refused = [](const lab::Row& row) { return !row.value("refusal", lab::Row()).is_null(); };
  const auto refused = std::count_if(rows.begin(), rows.end(), is_refused);
  if (refused > 0)
    std::fprintf(stderr, "aisle lab sweep: %td of %zu trials could not be run; the column refusal says why\n", refused,
                 rows.size());
}

int sweep(const Cli& cli, const SweepFlags& flags) {
  const lab::Sweep sweep = sweep_of(flags);
  const lab::TrialRunner runner(sweep);
  const std::vector<lab::Trial> trials = lab::trials_of(sweep, runner.queries());

  std::optional<lab::SweepFolder> folder;
  if (!flags.out.empty()) folder.emplace(flags.out, head_of(sweep, runner, trials), runner.columns());

  ProgressLine progress;
  lab::SweepRun how;
  how.workers = flags.workers;
  how.is_interrupted = is_interrupted;
  how.take = [&](const lab::Row& row) {
    if (folder) folder->append(row);
  };
  how.tell = [&](std::size_t done, std::size_t all) { progress.tell(fmt::format("trial {} of {}", done, all)); };

  const std::vector<lab::Row> rows = lab::run_sweep(
      trials, folder ? folder->kept() : std::map<std::size_t, lab::Row>{},
      [&](const lab::Trial& trial, const std::function<bool()>& stop) { return runner.run(trial, stop); }, how);
  progress.clear();

  std::printf("%s", cli.json ? (lab::Row(rows).dump() + "\n").c_str() : text_of(rows).c_str());
  tell_refusals(rows);
  if (rows.size() == trials.size()) return process::kDone;

  std::fprintf(stderr, "aisle lab sweep: stopped after %zu of %zu trials%s\n", rows.size(), trials.size(),
               folder ? "; the same command goes on" : "");
  return process::kNegative;
}

}  // namespace

void add_lab_sweep(CLI::App& parent, Cli& cli) {
  auto flags = std::make_shared<SweepFlags>();
  Verb verb(parent, cli, "sweep",
            "plan, or drive, every combination of maps, planners, parameters and seeds; a sweep that was stopped goes "
            "on with the same command");
  verb.option("--config", flags->config,
              "a YAML file with the sweep; --map, --kind, --scenario, --planner, --set and --vary add to it, other "
              "flags replace "
              "what it says")
      .list("--map", flags->maps, "own maps, one or more files: .png, .pgm, .yaml, .map, .txt")
      .list("--kind", flags->kinds, "kinds of the papers' maps, drawn by seed, e.g. wang-1")
      .list("--scenario", flags->scenarios, "with --drive: scenario files or families")
      .list("--planner", flags->planners, "global planners, one or more names, or all")
      .list("--local", flags->locals, "with --drive: local planners, one or more names, or all; default: wang")
      .list("--vary", flags->vary, "NAME.PARAMETER=VALUE/VALUE/..., e.g. wang.alpha=0.05/0.1/0.2; several times")
      .option("--seeds", flags->seeds, "of drives and of --kind, e.g. 1-30 or 1,2,5; default: 1")
      .option("--resolution", flags->map.resolution_m, 0.001, 1000.0, "m a pixel or cell of each --map")
      .option("--start", flags->map.start, "X,Y in metres in each map; default: its S")
      .option("--goal", flags->map.goal, "X,Y; default: its T")
      .option("--scen", flags->map.scen, "queries of each map, .scen or .q")
      .option("--limit", flags->map.limit, 1, 1'000'000, "at most so many of them, evenly spread over the file")
      .option("--radius", flags->radius_m, 0.0, 100.0, "m, of the vehicle with its margin, for paths; default: 0")
      .option("--safe-distance", flags->safe_distance_m, 0.0, 100.0, "m, of qu and yu, for paths; default: 0")
      .option("--vehicle-radius", flags->vehicle_radius_m, 0.01, 100.0, "m, of drives over maps; default: 0.35")
      .option("--workers", flags->workers, 1, 64,
              "threads; figures do not depend on it, but times (time_us, compute_us_*) do")
      .option("--out", flags->out, "folder for results.csv and results.jsonl; without it nothing is kept")
      .flag("--drive", flags->drives, "drive, do not only plan")
      .flag("--as-printed", flags->as_printed, "drive as the local planner's paper prints it")
      .flag("--paper-limits", flags->paper_limits, "vehicles as in the local planner's paper");
  add_parameter_flags(verb, flags->parameters);
  verb.runs([&cli, flags] { return sweep(cli, *flags); });
}

}  // namespace aisle::cli
