// aisle experiment traffic: how good the traffic is, beside free runs, the PIBT bound and a multi-agent plan.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/known_names.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/traffic_bounds/throughput_svg.hpp"
#include "tools/lab/traffic_bounds/traffic_experiment.hpp"
#include "tools/lab/traffic_bounds/traffic_tables.hpp"

namespace aisle::cli {
namespace {

/// The options of the command, with their defaults.
struct TrafficOrders {
  std::vector<std::string> vehicles;  // as typed; empty: as the experiment has them
  std::vector<std::string> floors;    // empty: all
  std::string map{"deploy/maps/warehouse.yaml"};
  std::string svg;
  int seed{1};
  double seconds{300.0};
  bool with_site{false};
};

std::size_t vehicles_of(const std::string& text) {
  std::size_t count = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (failure != std::errc() || end != text.data() + text.size() || count < 1 || count > lab::kMostPlanned)
    throw config::BadInput(fmt::format("--vehicles {}: a number from 1 to {} is needed", text, lab::kMostPlanned));
  return count;
}

lab::TrafficExperiment experiment_of(const TrafficOrders& orders) {
  lab::TrafficExperiment experiment;
  if (!orders.vehicles.empty()) experiment.vehicles.clear();
  for (const std::string& text : orders.vehicles) experiment.vehicles.push_back(vehicles_of(text));

  experiment.seed = static_cast<std::uint64_t>(orders.seed);
  experiment.seconds = orders.seconds;
  experiment.with_site = orders.with_site;
  experiment.goes_on = [] { return !is_interrupted(); };
  return experiment;
}

/// The floors that are asked for.
std::vector<lab::Floor> floors_of(const TrafficOrders& orders) {
  std::vector<lab::Floor> known = lab::known_floors(orders.map);
  std::vector<std::string> names;
  for (const lab::Floor& floor : known) names.push_back(floor.name);
  for (const std::string& name : orders.floors) check_name("--floor", name, names);
  if (orders.floors.empty()) return known;

  std::vector<lab::Floor> out;
  for (const lab::Floor& floor : known)
    if (std::find(orders.floors.begin(), orders.floors.end(), floor.name) != orders.floors.end()) out.push_back(floor);
  return out;
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number_or_null(const std::optional<double>& value) { return value ? number_or_null(*value) : Json(nullptr); }

Json as_json(const lab::StandFigures& stand) { return {{"seconds", stand.seconds}, {"cause", stand.cause}}; }

Json as_json(const lab::ReachedFigures& reached, double bound) {
  return {
      {"goals", reached.goals},
      {"goals_per_vehicle_hour", reached.goals_per_vehicle_hour},
      {"bound", number_or_null(bound)},
      {"bound_to_reached", reached.goals > 0 ? number_or_null(bound / reached.goals_per_vehicle_hour) : Json(nullptr)},
      {"time_to_alone", reached.time_to_alone},
      {"least_served", reached.least_served},
      {"most_served", reached.most_served},
      {"own_way_share", reached.own_way_share},
      {"longest_wait", as_json(reached.wait)},
      {"longest_standoff", as_json(reached.standoff)},
      {"findings", reached.findings},
      {"first_finding", reached.first_finding}};
}

Json as_json(const lab::OneShotFigures& shot, std::size_t vehicles) {
  return {{"goals", shot.goals},
          {"makespan_s", shot.makespan_s},
          {"alone_makespan_s", shot.alone_makespan_s},
          {"sum_of_times_s", shot.ends_s},
          {"alone_sum_of_times_s", shot.alone_ends_s},
          {"plan_cost_steps", shot.plan_cost > 0 ? Json(shot.plan_cost) : Json(nullptr)},
          {"plan_shortest_steps", shot.plan_cost > 0 ? Json(shot.plan_least_cost) : Json(nullptr)},
          {"one_shot", number_or_null(shot.ratio(vehicles))}};
}

Json as_json(const lab::FleetRow& row) {
  const auto nothing = Json(nullptr);
  return {{"vehicles", row.vehicles},
          {"pibt_steps_a_goal", number_or_null(row.steps_a_goal)},
          {"bound", number_or_null(row.bound)},
          {"roadmap_bound", number_or_null(row.roadmap_bound)},
          {"alone_goals_per_vehicle_hour", number_or_null(row.alone)},
          {"reached", row.reached ? as_json(*row.reached, row.bound) : nothing},
          {"one_shot", row.one_shot ? as_json(*row.one_shot, row.vehicles) : nothing},
          {"plans", Json{{"planned", row.plans.planned}, {"forecast_to_alone", row.plans.stretch()}}},
          {"site", row.site ? as_json(*row.site, row.site_bound.value_or(NAN)) : nothing},
          {"computing", Json{{"cycle_ms_mean", row.reached ? Json(row.reached->step_ms_mean) : nothing},
                             {"cycle_ms_p99", row.reached ? Json(row.reached->step_ms_p99) : nothing},
                             {"plans_from_nothing_s", row.plans.cpu_s}}}};
}

void print_json(const TrafficOrders& orders, const std::vector<lab::FloorFigures>& floors) {
  Json out{{"seed", orders.seed}, {"seconds", orders.seconds}, {"rule", lab::kFleetRule}, {"floors", Json::array()}};

  for (const lab::FloorFigures& floor : floors) {
    Json rows = Json::array();
    for (const lab::FleetRow& row : floor.rows) rows.push_back(as_json(row));
    out["floors"].push_back({{"floor", floor.floor},
                             {"places", floor.places},
                             {"step_s", number_or_null(floor.step_s)},
                             {"roadmap_step_s", number_or_null(floor.roadmap_step_s)},
                             {"site_step_s", number_or_null(floor.site_step_s)},
                             {"rows", rows}});
  }

  std::printf("%s\n", write_json(out).c_str());
}

void print_table(const char* title, const lab::Cells& table) {
  if (table.size() > 1) std::printf("\n%s\n%s", title, text_of_table(table).c_str());
}

void print_text(const TrafficOrders& orders, const std::vector<lab::FloorFigures>& floors) {
  std::printf("seed %d, %.0f s a run; goals of each fleet: %s\n", orders.seed, orders.seconds, lab::kFleetRule);

  for (const lab::FloorFigures& floor : floors) {
    std::printf("\n%s: %zu places; a step takes %.3f s alone on own ways, %.3f s by the roadmap", floor.floor.c_str(),
                floor.places, floor.step_s, floor.roadmap_step_s);
    if (floor.site_step_s) std::printf(", %.3f s on the simulated site", *floor.site_step_s);
    std::printf("\n");

    print_table("goals a vehicle and hour, vehicles that follow their road exactly", throughput_table(floor));
    print_table("goals a vehicle and hour, the simulated site with all services", site_table(floor));
    print_table("one goal each; plans from nothing", one_shot_table(floor));
    print_table("computing times of this machine", time_table(floor));

    std::printf("\n");
    for (const std::string& line : remarks(floor)) std::printf("%s\n", printable(line).c_str());
  }
}

/// Did nothing touch, and was no floor held twice?
bool is_clean(const std::vector<lab::FloorFigures>& floors) {
  for (const lab::FloorFigures& floor : floors)
    for (const lab::FleetRow& row : floor.rows)
      if ((row.reached && row.reached->findings > 0) || (row.site && row.site->findings > 0)) return false;
  return true;
}

int measure(const Cli& cli, const TrafficOrders& orders) {
  if (!orders.svg.empty()) process::check_writable(orders.svg);
  const lab::TrafficExperiment experiment = experiment_of(orders);
  const std::vector<lab::Floor> chosen = floors_of(orders);

  ProgressLine progress;
  std::vector<lab::FloorFigures> floors;
  for (const lab::Floor& floor : chosen) {
    if (is_interrupted()) break;
    floors.push_back(lab::measure_floor(floor, experiment, [&](const std::string& what) { progress.tell(what); }));
  }
  progress.clear();

  if (is_interrupted()) std::fprintf(stderr, "aisle experiment traffic: stopped; what is complete is printed\n");
  if (!orders.svg.empty()) process::write_output_file(orders.svg, lab::throughput_svg(floors));
  if (cli.json)
    print_json(orders, floors);
  else
    print_text(orders, floors);

  return is_clean(floors) && !is_interrupted() ? process::kDone : process::kNegative;
}

}  // namespace

void add_experiment_traffic(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<TrafficOrders>();
  Verb(parent, cli, "traffic",
       "the fleet's traffic beside each vehicle alone, the PIBT bound and a multi-agent plan without delays, on the "
       "demo's warehouse and, with the reference data, a block of the Moving AI warehouse; exit code 1 when something "
       "touched or floor was held twice")
      .list("--vehicles", orders->vehicles,
            fmt::format("sizes of fleets, 1 to {}; those over {} are planned only; default: 5 10 20 50 75 100",
                        lab::kMostPlanned, lab::kMostDriven))
      .list("--floor", orders->floors, "of warehouse, movingai; default: all that are there")
      .option("--map", orders->map, "the warehouse's map")
      .option("--seed", orders->seed, 0, 1'000'000'000, "of the fleets")
      .option("--seconds", orders->seconds, 10.0, 7200.0, "of each run")
      .flag("--site", orders->with_site,
            "on the simulated site too: real local planners, scans, tracker (takes a second a simulated one with 100 "
            "vehicles)")
      .option("--svg", orders->svg, "file for a picture of the rates against the vehicles")
      .runs([&cli, orders] { return measure(cli, *orders); });
}

}  // namespace aisle::cli
