// aisle plan: plans offline, on a map file, with one planner or all of them; one query, or every scenario of a file.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/planning/chosen_planners.hpp"
#include "tools/lab/planning/offline_plan.hpp"
#include "tools/lab/planning/plan_report.hpp"
#include "tools/lab/planning/plan_svg.hpp"
#include "tools/lab/planning/queries.hpp"

namespace aisle::cli {
namespace {

/// The flags as they were typed; numbers go straight to the task.
struct PlanOrders {
  std::string map, start, goal, scen, svg, footprint;
  std::vector<std::string> planners;
  int limit{1000000};
  lab::OfflineTask task;
};

constexpr double kFarthestLook_m = 5.0;  // clearances are looked at this far

/// Fills the task's queries: those of a file, or the typed one with its headings.
void add_queries(const grid::Geometry& geometry, PlanOrders& orders) {
  lab::OfflineTask& task = orders.task;
  if (!orders.scen.empty()) {
    if (!orders.start.empty() || !orders.goal.empty())
      throw config::BadInput("--scen has starts and goals: leave out --start and --goal");
    if (task.turning_radius_m > 0.0)
      throw config::BadInput("--turning-radius needs headings, which --scen has not: give --start and --goal");

    task.queries = lab::read_queries(orders.scen, geometry, static_cast<std::size_t>(orders.limit));
    return;
  }

  if (orders.start.empty() || orders.goal.empty())
    throw config::BadInput("give --start X,Y and --goal X,Y, or --scen FILE");

  const TypedPose start = parse_pose("--start", orders.start);
  const TypedPose goal = parse_pose("--goal", orders.goal);

  task.queries = {{start.in_map.position(), goal.in_map.position(), 0.0}};
  if (start.has_yaw) task.start_yaw_rad = start.in_map.yaw;
  if (goal.has_yaw) task.goal_yaw_rad = goal.in_map.yaw;
}

/// Plans every query with every chosen planner and prints their figures. Exit code 1 when one is not
/// solved, or a path fails the check.
int plan(const Cli& cli, PlanOrders& orders) {
  if (!orders.svg.empty()) process::check_writable(orders.svg);

  const std::vector<const global_planner::Variant*> planners = lab::chosen_planners(orders.planners);
  const grid::OccupancyGrid grid = grid::read_map_file(orders.map);

  add_queries(grid.geometry(), orders);

  const grid::ClearanceField clearance(grid, std::max(kFarthestLook_m, orders.task.needed_clearance_m() + 1.0));
  const lab::OfflineResult result = lab::plan_offline(orders.task, planners, clearance, is_interrupted);

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

  Verb(parent, cli, "plan",
       "plan on a map file, without a site: one query, or every scenario of a file; figures of each planner")
      .option("--map", orders->map, "ROS .yaml, Moving AI .map or text grid .txt; needed")
      .option("--start", orders->start, "X,Y in metres in the map's frame (X,Y,YAW for hybrid)")
      .option("--goal", orders->goal, "X,Y or X,Y,YAW")
      .list("--planner", orders->planners, "one or more names; all planners when left out")
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
      .option("--scen", orders->scen, "Moving AI scenarios (.scen), or lines of sx sy gx gy optimum (.q)")
      .option("--limit", orders->limit, 1, 1000000, "at most so many scenarios, evenly spread over the file")
      .flag("--nearest", orders->task.goes_to_nearest,
            "where the goal cannot be reached, go to the nearest point that can")
      .option("--svg", orders->svg, "write the map with the paths of the first query here")
      .runs([&cli, orders] {
        if (orders->map.empty()) throw config::BadInput("give --map FILE");
        if (!orders->footprint.empty() && orders->task.radius_m != 0.0)
          throw config::BadInput("--radius is for a disc, --footprint for a rectangle: give one");

        if (!orders->footprint.empty()) orders->task.outline = parse_footprint("--footprint", orders->footprint);
        return plan(cli, *orders);
      });
}

}  // namespace aisle::cli
