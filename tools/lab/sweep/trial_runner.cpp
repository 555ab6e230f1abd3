#include "tools/lab/sweep/trial_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_image.hpp"
#include "tools/lab/driving/map_drive.hpp"
#include "tools/lab/driving/printed_drive.hpp"
#include "tools/lab/planning/paper_maps.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

constexpr double kFarthestLookM = 5.0;  // clearances are looked at this far

/// A number where the text is one.
Row value_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
  return is_number ? Row(number) : Row(text);
}

/// FNV-1a over all that is added.
class Hash {
 public:
  void add(const std::string& text) {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
    add_byte('\n');
  }

  void add(const grid::OccupancyGrid& grid) {
    const grid::Geometry& it = grid.geometry();
    add(fmt::format("{} {} {} {} {}", it.width, it.height, it.resolution_m, it.origin_in_map.x, it.origin_in_map.y));
    for (const grid::Occupancy cell : grid.cells()) add_byte(static_cast<unsigned char>(cell));
  }

  /// The map and what is asked there, as they were read.
  void add(const Subject& subject) {
    add(subject.grid);
    for (const Query& it : subject.queries)
      add(fmt::format("{} {} {} {} {}", it.start_in_map.x, it.start_in_map.y, it.goal_in_map.x, it.goal_in_map.y,
                      it.optimum_m));

    const double none = std::nan("");
    add(fmt::format("{} {}", subject.start_yaw_rad.value_or(none), subject.goal_yaw_rad.value_or(none)));
  }

  void add(const std::vector<ParameterValue>& values) {
    for (const ParameterValue& value : values) add(value.full_name() + "=" + value.value);
  }

  std::string text() const { return fmt::format("{:016x}", hash_); }

 private:
  void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 1099511628211ULL; }

  std::uint64_t hash_{14695981039346656037ULL};
};

/// A family is part of the program; a file counts with its map and recordings.
void add_scenario(const std::string& name, Hash& hash) {
  const std::vector<std::string> families = sim::families();
  if (std::find(families.begin(), families.end(), name) != families.end()) return;

  const sim::Setup setup = sim::named_setup(name, 1);
  hash.add(grid::read_bytes(name));
  hash.add(setup.grid);
  for (const scenario::Recording& recording : setup.scenario.recordings) hash.add(grid::read_bytes(recording.file));
}

}  // namespace

TrialRunner::TrialRunner(const Sweep& sweep) : sweep_(sweep) {
  check(sweep);
  for (const SubjectOrders& orders : sweep.maps)
    maps_.push_back(std::make_shared<Loaded>(with_clearance(read_subject(orders))));
  for (const std::string& scenario : sweep.scenarios) sim::named_setup(scenario, sweep.seeds.front());
}

std::vector<std::size_t> TrialRunner::queries() const {
  std::vector<std::size_t> counts(subject_count(sweep_), 1);
  for (std::size_t i = 0; i < maps_.size(); ++i) counts[i] = maps_[i]->subject.queries.size();
  return counts;
}

std::vector<std::string> TrialRunner::columns() const {
  std::vector<std::string> columns{"trial", "subject", "query", "seed", "planner"};
  if (sweep_.drives) columns.emplace_back("local");
  for (const Variation& variation : sweep_.vary) columns.push_back(variation.parameter.full_name());
  for (const std::string& column : figure_columns()) columns.push_back(column);
  columns.emplace_back("refusal");
  return columns;
}

std::optional<Row> TrialRunner::run(const Trial& trial, const std::function<bool()>& is_interrupted) const {
  Row row = leading(trial);
  row.update(figures(trial, is_interrupted));
  if (is_interrupted()) return std::nullopt;
  return row;
}

Row TrialRunner::figures(const Trial& trial, const std::function<bool()>& is_interrupted) const {
  try {
    Row row = sweep_.drives ? driven(trial, is_interrupted) : planned(trial, is_interrupted);
    row["refusal"] = nullptr;
    return row;
  } catch (const config::BadInput& error) {
    return refused(error.what());
  } catch (const std::invalid_argument& error) {  // values that a planner takes one by one, but not together
    return refused(error.what());
  }
}

Row TrialRunner::refused(const std::string& why) const {
  Row row = Row::object();
  for (const std::string& column : figure_columns()) row[column] = nullptr;
  row["refusal"] = why;
  return row;
}

TrialRunner::Loaded TrialRunner::with_clearance(Subject subject) const {
  std::unique_ptr<grid::ClearanceField> clearance;
  if (!sweep_.drives) {
    const double needed_m = std::max(sweep_.radius_m, sweep_.safe_distance_m) + 1.0;
    clearance = std::make_unique<grid::ClearanceField>(subject.grid, std::max(kFarthestLookM, needed_m));
  }
  return {std::move(subject), std::move(clearance)};
}

std::shared_ptr<const TrialRunner::Loaded> TrialRunner::loaded(const Trial& trial) const {
  if (trial.subject < maps_.size()) return maps_[trial.subject];

  const PaperMapKind& kind = *find_paper_map_kind(subject_name(sweep_, trial.subject));
  DrawnMap map = paper_map(kind, static_cast<unsigned>(trial.seed));
  return std::make_shared<Loaded>(with_clearance({std::move(map.grid), {{map.start_in_map, map.goal_in_map, 0.0}}}));
}

Row TrialRunner::leading(const Trial& trial) const {
  Row row{{"trial", trial.index},
          {"subject", subject_name(sweep_, trial.subject)},
          {"query", trial.query},
          {"seed", trial.seed},
          {"planner", trial.planner}};
  if (sweep_.drives) row["local"] = trial.local;

  for (const Variation& variation : sweep_.vary) row[variation.parameter.full_name()] = nullptr;
  for (const ParameterValue& value : trial.values) row[value.full_name()] = value_of(value.value);

  return row;
}

std::vector<ParameterValue> TrialRunner::values_of(const Trial& trial) const {
  std::vector<ParameterValue> values = sweep_.set;
  values.insert(values.end(), trial.values.begin(), trial.values.end());
  return values;
}

Row TrialRunner::planned(const Trial& trial, const std::function<bool()>& is_interrupted) const {
  const std::shared_ptr<const Loaded> map = loaded(trial);

  OfflineTask task;
  task.queries = {map->subject.queries[trial.query]};
  task.start_yaw_rad = map->subject.start_yaw_rad;
  task.goal_yaw_rad = map->subject.goal_yaw_rad;
  task.radius_m = sweep_.radius_m;
  task.outline = geometry::disc(0.0);
  task.safe_distance_m = sweep_.safe_distance_m;
  task.parameters[trial.planner] = global_parameters(values_of(trial), trial.planner);

  Row row = Row::object();
  plan_offline(task, {global_planner::find_variant(trial.planner)}, *map->clearance, is_interrupted,
               [&](const OfflineAnswer& answer) { row = plan_figures(answer); });
  return row;
}

Row TrialRunner::driven(const Trial& trial, const std::function<bool()>& is_interrupted) const {
  const std::vector<ParameterValue> values = values_of(trial);
  const std::string name = subject_name(sweep_, trial.subject);
  const local_planner::Variant variant = local_variant(values, trial.local);

  sim::Setup setup;
  if (trial.subject >= sweep_.maps.size() + sweep_.kinds.size()) {
    setup = sim::named_setup(name, trial.seed);
  } else {
    const std::shared_ptr<const Loaded> map = loaded(trial);
    const Query& query = map->subject.queries[trial.query];
    setup = sweep_.as_printed ? printed_setup({map->subject.grid, query.start_in_map, query.goal_in_map}, variant,
                                              trial.planner, map->subject.start_yaw_rad)
                              : map_setup(name, map->subject, query, sweep_.vehicle_radius_m);
    if (sweep_.as_printed) check_ends(name, setup.grid, query, variant.printed.radius_m);
  }

  setup.seed = trial.seed;
  setup.planner = trial.planner;
  setup.local = trial.local;
  setup.own_variant = variant;
  setup.paper_limits = sweep_.paper_limits || sweep_.as_printed;
  setup.planner_parameters = global_parameters(values, trial.planner);
  set_settings(values, setup.fleet, setup.settings);

  std::vector<double> compute_us;
  sim::Hooks hooks;
  hooks.goes_on = [&](double) { return !is_interrupted(); };
  hooks.on_cycle = [&](const sim::Cycle& cycle) { compute_us.push_back(cycle.compute_us); };

  sim::Totals totals;
  totals.add(sim::drive(setup, {}, hooks).result);

  return drive_figures(totals, compute_us);
}

std::string TrialRunner::fingerprint(const std::vector<Trial>& trials) const {
  Hash hash;
  hash.add(fmt::format("{} {} {} {} {} {}", sweep_.drives, sweep_.as_printed, sweep_.paper_limits, sweep_.radius_m,
                       sweep_.safe_distance_m, sweep_.vehicle_radius_m));
  for (const std::shared_ptr<const Loaded>& map : maps_) hash.add(map->subject);
  for (const std::string& scenario : sweep_.scenarios) add_scenario(scenario, hash);
  hash.add(sweep_.set);

  for (const Trial& trial : trials) {
    hash.add(fmt::format("{} {} {} {} {}", subject_name(sweep_, trial.subject), trial.query, trial.seed, trial.planner,
                         trial.local));
    hash.add(trial.values);
  }

  return hash.text();
}

}  // namespace aisle::lab
