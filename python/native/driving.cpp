#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "python/native/arguments.hpp"
#include "python/native/arrays.hpp"
#include "python/native/bindings.hpp"
#include "python/native/map.hpp"
#include "services/local-planner/core/parameters.hpp"
#include "tools/lab/driving/map_drive.hpp"
#include "tools/lab/driving/printed_drive.hpp"
#include "tools/lab/planning/chosen_planners.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::python {
namespace {

namespace py = pybind11;
using local_planner::Variant;

/// @throws config::BadInput with the nearest name
Variant variant_of(const std::string& name) {
  if (const Variant* variant = local_planner::find_variant(name)) return *variant;

  std::vector<std::string> known;
  for (const Variant& variant : local_planner::all_variants()) known.push_back(variant.name);
  const std::string nearest = config::nearest_name(name, known);
  throw config::BadInput("local: '" + name + "' is unknown; " +
                         (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") + "there are " +
                         local_planner::variant_names());
}

/// Everything that drive() of Python decides.
struct Orders {
  std::string scenario;  // empty: `map` is driven
  std::shared_ptr<Map> map;
  lab::Place start, goal;
  std::string local;
  std::string planner;
  std::vector<lab::ParameterValue> parameters;
  bool as_printed{false};
  bool paper_limits{false};
  bool truth{false};
  double radius_m{0.35};  // of the vehicle on a map
  std::uint64_t seed{1};
};

// Of the vehicle on a map.
constexpr double kLeastRadiusM = 0.01, kLargestRadiusM = 100.0;

bool is_local(const lab::ParameterValue& value) { return value.side == lab::Side::kLocal; }

/// What is driven: a scenario, or one vehicle over a map, by our own drive or as printed.
sim::Setup subject_of(const Orders& orders, const Variant& variant) {
  if (orders.map == nullptr) return sim::named_setup(orders.scenario, orders.seed);

  const lab::Query query{orders.start.in_map, orders.goal.in_map, 0.0};
  const grid::OccupancyGrid& grid = orders.map->grid();
  if (!orders.as_printed)
    return lab::map_setup("map", {grid, {query}, orders.start.yaw_rad, orders.goal.yaw_rad}, query, orders.radius_m);

  lab::check_ends("map", grid, query, variant.printed.radius_m);
  return lab::printed_setup({grid, query.start_in_map, query.goal_in_map}, variant, orders.planner,
                            orders.start.yaw_rad);
}

/// The subject, and what drives it.
sim::Setup setup_of(const Orders& orders) {
  lab::check_in_use("parameters", orders.parameters,
                    {{orders.planner}, {orders.local}, orders.paper_limits, orders.as_printed});
  const Variant variant = lab::local_variant(orders.parameters, orders.local);
  sim::Setup setup = subject_of(orders, variant);
  setup.local = variant.name;
  if (std::any_of(orders.parameters.begin(), orders.parameters.end(), is_local)) setup.own_variant = variant;
  if (!orders.as_printed) setup.paper_limits = orders.paper_limits;
  if (orders.truth) setup.perception = sim::Perception::kTruth;

  setup.planner = orders.planner;
  setup.planner_parameters = lab::global_parameters(orders.parameters, orders.planner);
  lab::set_settings(orders.parameters, setup.fleet, setup.settings);
  setup.seed = orders.seed;
  return setup;
}

/// What is taken of each cycle, in this order; see lab::DriveRows.
constexpr std::array<const char*, 9> kColumns{"t_s",     "x_m",          "y_m",         "yaw_rad",   "v_mps",
                                              "w_radps", "sideways_mps", "clearance_m", "compute_us"};

/// The cycles of each vehicle, by its id: kColumns, row by row.
using Samples = std::map<std::string, std::vector<double>>;

/// Those of all vehicles, in one pass.
Samples samples_of(const lab::DriveRows& rows) {
  Samples samples;
  for (const lab::Row& row : rows.rows()) {
    if (row.at("kind") != "cycle") continue;

    std::vector<double>& values = samples[row.at("agv").get<std::string>()];
    for (const char* column : kColumns) values.push_back(row.at(column).get<double>());
  }

  return samples;
}

py::dict dict_of(const sim::Setup& setup, const sim::Outcome& outcome, Samples& samples) {
  const sim::Result& result = outcome.result;
  py::list vehicles;
  for (const scenario::Vehicle& vehicle : setup.scenario.vehicles)
    vehicles.append(py::make_tuple(vehicle.id, array_of(samples[vehicle.id], kColumns.size())));

  py::list failed;
  for (const referee::GoalRecord& goal : outcome.report.goals)
    if (goal.outcome != referee::GoalOutcome::kReached) failed.append(py::make_tuple(goal.agv_id, goal.reason));

  const bool has_least = result.least_clearance_m < sim::kNothingNearM;
  using namespace pybind11::literals;
  return py::dict(
      "goals_assigned"_a = result.goals_assigned, "goals_reached"_a = result.goals_reached,
      "contacts"_a = result.contacts, "contacts_moving_vehicle"_a = result.contacts_moving_vehicle,
      "least_clearance_m"_a = has_least ? result.least_clearance_m : std::numeric_limits<double>::quiet_NaN(),
      "distance_m"_a = result.distance_m, "planned_m"_a = result.planned_m, "time_s"_a = result.time_s,
      "first_goal_s"_a = result.first_goal_s, "driven_s"_a = result.driven_s, "replans"_a = result.replans,
      "turn_sign_changes"_a = result.turn_sign_changes, "trace_hash"_a = fmt::format("{:016x}", result.trace_hash),
      "log"_a = result.log, "goals_failed"_a = failed, "vehicles"_a = vehicles);
}

py::dict drive(const Orders& orders) {
  sim::Setup setup;
  Samples samples;
  sim::Outcome outcome;
  {
    const py::gil_scoped_release unlocked;
    setup = setup_of(orders);
    lab::DriveRows rows(setup);

    sim::Hooks hooks;
    hooks.on_cycle = [&](const sim::Cycle& cycle) { rows.take(cycle); };
    hooks.goes_on = [is_interrupted = interruption(1)](double) { return !is_interrupted(); };
    outcome = sim::drive(setup, {}, hooks);
    samples = samples_of(rows);
  }

  raise_if_interrupted();
  return dict_of(setup, outcome, samples);
}

py::list local_planners() {
  py::list all;
  for (const Variant& variant : local_planner::all_variants())
    all.append(py::make_tuple(variant.name, variant.summary));
  return all;
}

/// That of the same paper. @throws config::BadInput
std::string global_planner_of(const std::string& local) { return lab::global_planner_of(variant_of(local)); }

}  // namespace

void bind_driving(py::module_& module) {
  module.def("local_planners", &local_planners);
  module.def("global_planner_of", &global_planner_of, py::arg("local"));
  module.def("scenario_families", &sim::families);
  module.def(
      "drive",
      [](const std::string& scenario, const std::shared_ptr<Map>& map, const std::vector<double>& start,
         const std::vector<double>& goal, const std::string& local, const std::string& planner, const Texts& parameters,
         bool as_printed, bool paper_limits, bool truth, double radius_m, std::uint64_t seed) {
        Orders orders;
        orders.scenario = scenario;
        orders.map = map;
        if (map != nullptr) {
          orders.start = place_of("start", start);
          orders.goal = place_of("goal", goal);
        }
        orders.local = variant_of(local).name;
        orders.planner = lab::chosen_planners({planner}).front()->name;
        orders.parameters = values_of(parameters, lab::Side::kLocal, local);
        orders.as_printed = as_printed;
        orders.paper_limits = paper_limits;
        orders.truth = truth;
        orders.radius_m = within("radius_m", radius_m, kLeastRadiusM, kLargestRadiusM);
        orders.seed = seed;
        return drive(orders);
      },
      py::arg("scenario"), py::arg("map"), py::arg("start"), py::arg("goal"), py::arg("local"), py::arg("planner"),
      py::arg("parameters"), py::arg("as_printed"), py::arg("paper_limits"), py::arg("truth"), py::arg("radius_m"),
      py::arg("seed"));
}

}  // namespace aisle::python
