#include "tools/lab/sweep/trial_runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "common/grid/formats/map_image.hpp"
#include "tools/lab/driving/map_drive.hpp"
#include "tools/lab/driving/printed_drive.hpp"
#include "tools/lab/planning/paper_maps.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/lab/sweep/plan_rows.hpp"
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

/// FNV-1a.
void hash_in(const std::string& text, std::uint64_t& hash) {
  for (const char c : text + '\n') hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
}

/// The map and what is asked there.
void hash_in(const SubjectOrders& orders, std::uint64_t& hash) {
  hash_in(grid::read_bytes(orders.map), hash);
  if (!orders.scen.empty()) hash_in(grid::read_bytes(orders.scen), hash);
  hash_in(fmt::format("{} {}", orders.cell_m, orders.limit), hash);

  for (const std::optional<Place>& place : {orders.start, orders.goal}) {
    if (!place) continue;
    const double yaw_rad = place->yaw_rad.value_or(std::nan(""));
    hash_in(fmt::format("{} {} {}", place->in_map.x, place->in_map.y, yaw_rad), hash);
  }
}

}  // namespace

TrialRunner::TrialRunner(const Sweep& sweep) : sweep_(sweep) {
  check(sweep);
  for (const SubjectOrders& orders : sweep.maps)
    maps_.push_back(std::make_shared<Loaded>(with_clearance(read_subject(orders))));
}

std::vector<std::size_t> TrialRunner::queries() const {
  std::vector<std::size_t> counts(subject_count(sweep_), 1);
  for (std::size_t i = 0; i < maps_.size(); ++i) counts[i] = maps_[i]->subject.queries.size();
  return counts;
}

std::vector<std::string> TrialRunner::leading_columns() const {
  std::vector<std::string> columns{"trial", "subject", "query", "seed", "planner"};
  if (sweep_.drives) columns.emplace_back("local");
  for (const Variation& variation : sweep_.vary) columns.push_back(variation.parameter.full_name());
  return columns;
}

std::optional<Row> TrialRunner::run(const Trial& trial, const std::function<bool()>& is_interrupted) const {
  Row row = leading(trial);
  row.update(sweep_.drives ? driven(trial, is_interrupted) : planned(trial, is_interrupted));
  if (is_interrupted()) return std::nullopt;
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
    setup = sweep_.as_printed
                ? printed_setup({map->subject.grid, query.start_in_map, query.goal_in_map}, variant, trial.planner)
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

std::string fingerprint(const Sweep& sweep, const std::vector<Trial>& trials) {
  std::uint64_t hash = 14695981039346656037ULL;
  hash_in(fmt::format("{} {} {} {} {} {}", sweep.drives, sweep.as_printed, sweep.paper_limits, sweep.radius_m,
                      sweep.safe_distance_m, sweep.vehicle_radius_m),
          hash);
  for (const SubjectOrders& orders : sweep.maps) hash_in(orders, hash);
  for (const ParameterValue& value : sweep.set) hash_in(value.full_name() + "=" + value.value, hash);

  for (const Trial& trial : trials) {
    hash_in(fmt::format("{} {} {} {} {}", subject_name(sweep, trial.subject), trial.query, trial.seed, trial.planner,
                        trial.local),
            hash);
    for (const ParameterValue& value : trial.values) hash_in(value.full_name() + "=" + value.value, hash);
  }

  return fmt::format("{:016x}", hash);
}

}  // namespace aisle::lab
