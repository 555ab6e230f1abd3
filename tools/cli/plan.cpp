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
#include "services/global-planner/core/nearest_reachable.hpp"
#include "services/global-planner/core/refusal.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/planning/chosen_planners.hpp"
#include "tools/lab/planning/plan_report.hpp"
#include "tools/lab/planning/plan_svg.hpp"
#include "tools/lab/planning/queries.hpp"

namespace aisle::cli {
namespace {

using global_planner::Outcome;
using global_planner::Problem;
using global_planner::Variant;
using lab::Answer;
using lab::Query;
using lab::Tally;

struct PlanOrders {
  std::string map, start, goal, scen, svg, footprint;
  std::vector<std::string> planners;
  double radius_m{0.0};
  geometry::Footprint outline{geometry::disc(0.0)};  // what `footprint` says
  double safe_distance_m{0.0};
  double preferred_clearance_m{0.0};
  double turning_radius_m{0.0};
  int limit{1000000};
  bool nearest{false};
};

constexpr double kFarthestLook_m = 5.0;  // clearances are looked at this far

std::vector<Query> queries_of(const PlanOrders& orders, const grid::Geometry& geometry) {
  if (!orders.scen.empty()) {
    if (!orders.start.empty() || !orders.goal.empty())
      throw config::BadInput("--scen has starts and goals: leave out --start and --goal");
    if (orders.turning_radius_m > 0.0)
      throw config::BadInput("--turning-radius needs headings, which --scen has not: give --start and --goal");
    return lab::read_queries(orders.scen, geometry, static_cast<std::size_t>(orders.limit));
  }
  if (orders.start.empty() || orders.goal.empty())
    throw config::BadInput("give --start X,Y and --goal X,Y, or --scen FILE");
  return {{parse_pose("--start", orders.start).in_map.position(), parse_pose("--goal", orders.goal).in_map.position(),
           0.0}};
}

/// Discs that hold the vehicle: some along it for a planner that knows where it heads; else the one in which it can
/// turn.
void cover(const PlanOrders& orders, const Variant& variant, Problem& problem) {
  problem.radius_m = orders.outline.is_disc() ? orders.radius_m : geometry::reach_m(orders.outline);
  const bool is_steered = variant.knows_headings && orders.turning_radius_m > 0.0;
  if (orders.outline.is_disc() || !is_steered) return;
  const geometry::CoveringDiscs discs = geometry::covering_discs(orders.outline);
  problem.radius_m = discs.radius_m;
  problem.steering.discs_ahead_m = discs.ahead_m;
}

Problem problem_of(const PlanOrders& orders, const Variant& variant, const grid::ClearanceField& clearance,
                   const Query& query) {
  Problem problem{clearance, query.start_in_map, query.goal_in_map};
  problem.safe_distance_m = orders.safe_distance_m;
  problem.preferred_clearance_m = orders.preferred_clearance_m;
  cover(orders, variant, problem);
  if (orders.scen.empty()) {
    problem.steering.turning_radius_m = orders.turning_radius_m;
    problem.steering.start_yaw_rad = parse_pose("--start", orders.start).in_map.yaw;
    const TypedPose goal = parse_pose("--goal", orders.goal);
    if (goal.has_yaw) problem.steering.goal_yaw_rad = goal.in_map.yaw;
  }
  return problem;
}

global_planner::Outline outline_of(const PlanOrders& orders) {
  global_planner::Outline outline{orders.outline, {}, {}};
  if (!orders.scen.empty()) return outline;
  const TypedPose start = parse_pose("--start", orders.start);
  const TypedPose goal = parse_pose("--goal", orders.goal);
  if (start.has_yaw) outline.start_yaw_rad = start.in_map.yaw;
  if (goal.has_yaw) outline.goal_yaw_rad = goal.in_map.yaw;
  return outline;
}

/// The grid's optimum for this vehicle, which the file does not know.
double optimum_m(const Problem& problem) {
  const global_planner::PlannedPath plan = global_planner::find_variant("jps")->make()->plan(problem, is_interrupted);
  return plan.outcome == Outcome::kFound ? plan.length_m : 0.0;
}

bool is_helped_by_nearest(Outcome outcome) { return outcome == Outcome::kGoalBlocked || outcome == Outcome::kNoPath; }

struct Run {
  std::vector<Tally> tallies;
  std::vector<lab::DrawnPath> paths;  // of the first query
  std::string refusal;                // of the first query that was refused
};

Run run(const PlanOrders& orders, const std::vector<const Variant*>& variants, const grid::ClearanceField& clearance,
        const std::vector<Query>& queries) {
  Run result;
  const global_planner::Outline outline = outline_of(orders);
  for (const Variant* variant : variants) {
    Tally tally(variant->name);
    const std::unique_ptr<global_planner::Planner> planner = variant->make();
    for (std::size_t i = 0; i < queries.size() && !is_interrupted(); ++i) {
      Problem problem = problem_of(orders, *variant, clearance, queries[i]);
      Answer answer = lab::ask(*planner, problem, outline);
      if (orders.nearest && is_helped_by_nearest(answer.plan.outcome)) {
        problem.goal_in_map = global_planner::nearest_reachable(problem, is_interrupted).value_or(problem.goal_in_map);
        answer = lab::ask(*planner, problem, outline);
      }
      tally.add(answer, queries[i].optimum_m > 0.0 ? queries[i].optimum_m
                        : queries.size() == 1      ? optimum_m(problem)
                                                   : 0.0);
      if (i == 0 && answer.plan.outcome == Outcome::kFound)
        result.paths.push_back({variant->name, answer.plan.waypoints_in_map});
      if (answer.plan.outcome == Outcome::kFound || !result.refusal.empty()) continue;
      const global_planner::RefusalReport report =
          global_planner::explain(problem, answer.plan.outcome, is_interrupted);
      result.refusal = std::string(name(report.refusal)) + ": " + report.line;
    }
    result.tallies.push_back(std::move(tally));
  }
  return result;
}

int plan_offline(const Cli& cli, const PlanOrders& orders) {
  if (!orders.svg.empty()) process::check_writable(orders.svg);
  const std::vector<const Variant*> variants = lab::chosen_planners(orders.planners);
  const grid::OccupancyGrid grid = grid::read_map_file(orders.map);
  const std::vector<Query> queries = queries_of(orders, grid.geometry());
  const double needed_m = std::max(
      {orders.radius_m, geometry::reach_m(orders.outline), orders.safe_distance_m, orders.preferred_clearance_m});
  const grid::ClearanceField clearance(grid, std::max(kFarthestLook_m, needed_m + 1.0));
  const Run result = run(orders, variants, clearance, queries);

  std::printf("%s", cli.json ? (lab::json_of(result.tallies).dump() + "\n").c_str()
                             : text_of_table(lab::rows_of(result.tallies)).c_str());
  if (!orders.svg.empty()) process::write_output_file(orders.svg, lab::plan_svg(grid, result.paths));
  bool is_clean = !is_interrupted();
  for (const Tally& tally : result.tallies) {
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
      .option("--radius", orders->radius_m, 0.0, 100.0, "of a round vehicle with its margin, in metres")
      .option("--footprint", orders->footprint,
              "LENGTH,WIDTH or LENGTH,WIDTH,AHEAD in metres: a rectangle instead of --radius, its middle AHEAD of the "
              "vehicle's frame; paths are checked for it")
      .option("--safe-distance", orders->safe_distance_m, 0.0, 100.0, "that qu and yu keep beside the lines they draw")
      .option("--prefer-clearance", orders->preferred_clearance_m, 0.0, 100.0,
              "nearer to obstacles than this a metre costs more (clear)")
      .option("--turning-radius", orders->turning_radius_m, 0.0, 100.0,
              "of a vehicle that cannot turn on the spot (hybrid)")
      .option("--scen", orders->scen, "Moving AI scenarios (.scen), or lines of sx sy gx gy optimum (.q)")
      .option("--limit", orders->limit, 1, 1000000, "at most so many scenarios, evenly spread over the file")
      .flag("--nearest", orders->nearest, "where the goal cannot be reached, go to the nearest point that can")
      .option("--svg", orders->svg, "write the map with the paths of the first query here")
      .runs([&cli, orders] {
        if (orders->map.empty()) throw config::BadInput("give --map FILE");
        if (!orders->footprint.empty() && orders->radius_m != 0.0)
          throw config::BadInput("--radius is for a disc, --footprint for a rectangle: give one");
        if (!orders->footprint.empty()) orders->outline = parse_footprint("--footprint", orders->footprint);
        return plan_offline(cli, *orders);
      });
}

}  // namespace aisle::cli
