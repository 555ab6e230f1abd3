// aisle plan: plans offline, on a map file, with one planner or all of them; one query, or every scenario of a file.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/lab_options.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/planning/chosen_planners.hpp"
#include "tools/lab/planning/offline_plan.hpp"
#include "tools/lab/planning/plan_report.hpp"
#include "tools/lab/planning/plan_svg.hpp"
#include "tools/lab/results/provenance.hpp"
#include "tools/lab/results/result_text.hpp"
#include "tools/lab/sweep/plan_rows.hpp"

namespace aisle::cli {
namespace {

/// The flags as they were typed; numbers go straight to the task.
struct PlanOrders {
  MapFlags map;
  ParameterFlags parameters;
  std::string svg, footprint, csv, jsonl;
  std::vector<std::string> planners;
  lab::OfflineTask task;
};

constexpr double kFarthestLook_m = 5.0;  // clearances are looked at this far

/// The map; its queries and headings go to the task.
grid::OccupancyGrid read_map(PlanOrders& orders) {
  lab::OfflineTask& task = orders.task;
  if (!orders.map.scen.empty() && task.turning_radius_m > 0.0)
    throw config::BadInput("--turning-radius needs headings, which --scen has not: give --start and --goal");

  lab::Subject subject = lab::read_subject(subject_orders_of(orders.map));
  task.queries = std::move(subject.queries);
  task.start_yaw_rad = subject.start_yaw_rad;
  task.goal_yaw_rad = subject.goal_yaw_rad;

  return std::move(subject.grid);
}

/// Of the planners that are asked, by name; also put into the task.
std::vector<lab::ParameterValue> set_parameters(const std::vector<const global_planner::Variant*>& planners,
                                                PlanOrders& orders) {
  lab::InUse in_use;
  for (const global_planner::Variant* planner : planners) in_use.global.push_back(planner->name);

  const std::vector<lab::ParameterValue> values = parameters_of(orders.parameters, in_use, lab::Side::kGlobal);
  for (const std::string& planner : in_use.global)
    orders.task.parameters[planner] = lab::global_parameters(values, planner);

  return values;
}

/// Before planning, which may take minutes.
void check_files(const PlanOrders& orders) {
  for (const std::string& file : {orders.svg, orders.csv, orders.jsonl})
    if (!file.empty()) process::check_writable(file);
}

void write_rows(const PlanOrders& orders, const std::vector<lab::ParameterValue>& values,
                const std::vector<lab::Row>& rows) {
  const lab::OfflineTask& task = orders.task;
  lab::Row particular{{"map", orders.map.map},
                      {"seed", nullptr},
                      {"parameters", listed_values(values)},
                      {"radius_m", task.radius_m},
                      {"footprint", orders.footprint},
                      {"safe_distance_m", task.safe_distance_m},
                      {"preferred_clearance_m", task.preferred_clearance_m},
                      {"turning_radius_m", task.turning_radius_m},
                      {"nearest", task.goes_to_nearest}};
  particular.update(head_rows(orders.map));

  const lab::Row head = lab::head_of("aisle plan", lab::provenance(), particular);
  if (!orders.csv.empty()) process::write_output_file(orders.csv, lab::csv_text(head, rows));
  if (!orders.jsonl.empty()) process::write_output_file(orders.jsonl, lab::jsonl_text(head, rows));
}

/// Plans every query with every chosen planner and prints their figures. Exit code 1 when one is not
/// solved, or a path fails the check.
int plan(const Cli& cli, PlanOrders& orders) {
  check_files(orders);

  const std::vector<const global_planner::Variant*> planners = lab::chosen_planners(orders.planners);
  const std::vector<lab::ParameterValue> values = set_parameters(planners, orders);
  const grid::OccupancyGrid grid = read_map(orders);
  const grid::ClearanceField clearance(grid, std::max(kFarthestLook_m, orders.task.needed_clearance_m() + 1.0));

  std::vector<lab::Row> rows;
  const bool keeps_rows = !orders.csv.empty() || !orders.jsonl.empty();
  const lab::OfflineResult result =
      lab::plan_offline(orders.task, planners, clearance, is_interrupted, [&](const lab::OfflineAnswer& answer) {
        if (!keeps_rows) return;
        for (lab::Row& row : lab::plan_rows(answer, clearance)) rows.push_back(std::move(row));
      });
  if (keeps_rows) write_rows(orders, values, rows);

  std::printf("%s", cli.json ? (lab::json_of(result.tallies).dump() + "\n").c_str()
                             : text_of_table(lab::rows_of(result.tallies)).c_str());
  if (!orders.svg.empty()) process::write_output_file(orders.svg, lab::plan_svg(grid, result.paths));

  // Exit code 0: everything was solved, and no path failed the check.
  bool is_clean = !is_interrupted();
  for (const lab::Tally& tally : result.tallies) {
    is_clean = is_clean && tally.solved() == tally.asked() && tally.checker_failures() == 0;
    if (tally.checker_failures() > 0)
      std::fprintf(stderr, "aisle plan: %s: a path %s\n", tally.planner().c_str(), tally.first_fault().c_str());
  }

  if (!result.refusal.empty()) std::fprintf(stderr, "aisle plan: %s\n", result.refusal.c_str());
  return is_clean ? process::kDone : process::kNegative;
}

}  // namespace

void add_plan(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<PlanOrders>();

  Verb verb(parent, cli, "plan",
            "plan on a map file, without a site: one query, or every scenario of a file; figures of each planner");
  add_map_flags(verb, orders->map);
  add_parameter_flags(verb, orders->parameters);
  verb.list("--planner", orders->planners, "one or more names; all planners when left out")
      .option("--radius", orders->task.radius_m, 0.0, 100.0, "of a round vehicle with its margin, in metres")
      .option("--footprint", orders->footprint,
              "LENGTH,WIDTH or LENGTH,WIDTH,AHEAD in metres: a rectangle instead of --radius, its middle AHEAD of the "
              "vehicle's frame; paths are checked for it")
      .option("--safe-distance", orders->task.safe_distance_m, 0.0, 100.0,
              "that qu and yu keep beside the lines they draw")
      .option("--prefer-clearance", orders->task.preferred_clearance_m, 0.0, 100.0,
              "nearer to obstacles than this a metre costs more (clear)")
      .option("--turning-radius", orders->task.turning_radius_m, 0.0, 100.0,
              "of a vehicle that cannot turn on the spot (hybrid)")
      .flag("--nearest", orders->task.goes_to_nearest,
            "where the goal cannot be reached, go to the nearest point that can")
      .option("--csv", orders->csv, "write figures and waypoints of each path here, as CSV")
      .option("--jsonl", orders->jsonl, "the same as JSON Lines")
      .option("--svg", orders->svg, "write the map with the paths of the first query here")
      .runs([&cli, orders] {
        if (orders->map.map.empty()) throw config::BadInput("give --map FILE");
        if (!orders->footprint.empty() && orders->task.radius_m != 0.0)
          throw config::BadInput("--radius is for a disc, --footprint for a rectangle: give one");

        if (!orders->footprint.empty()) orders->task.outline = parse_footprint("--footprint", orders->footprint);
        return plan(cli, *orders);
      });
}

}  // namespace aisle::cli
