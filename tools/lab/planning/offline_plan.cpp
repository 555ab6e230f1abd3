#include "tools/lab/planning/offline_plan.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "services/global-planner/core/nearest_reachable.hpp"
#include "services/global-planner/core/refusal.hpp"

namespace aisle::lab {
namespace {

using global_planner::Outcome;
using global_planner::Problem;
using global_planner::Variant;
using Interrupted = std::function<bool()>;

/// Discs that hold the vehicle: some along it for a planner that knows headings; else the one in which it can turn.
void cover(const OfflineTask& task, const Variant& variant, Problem& problem) {
  problem.radius_m = task.outline.is_disc() ? task.radius_m : geometry::reach_m(task.outline);

  const bool is_steered = variant.knows_headings && task.turning_radius_m > 0.0;
  if (task.outline.is_disc() || !is_steered) return;

  const geometry::CoveringDiscs discs = geometry::covering_discs(task.outline);
  problem.radius_m = discs.radius_m;
  problem.steering.discs_ahead_m = discs.ahead_m;
}

/// One query as this planner gets it.
Problem problem_of(const OfflineTask& task, const Variant& variant, const grid::ClearanceField& clearance,
                   const Query& query) {
  Problem problem{clearance, query.start_in_map, query.goal_in_map};
  problem.safe_distance_m = task.safe_distance_m;
  problem.preferred_clearance_m = task.preferred_clearance_m;
  cover(task, variant, problem);
  problem.steering.turning_radius_m = task.turning_radius_m;
  problem.steering.start_yaw_rad = task.start_yaw_rad.value_or(0.0);
  if (task.goal_yaw_rad) problem.steering.goal_yaw_rad = *task.goal_yaw_rad;

  return problem;
}

/// The grid's optimum for this vehicle, which a file of queries does not know.
double optimum_m(const Problem& problem, const Interrupted& is_interrupted) {
  const auto plan = global_planner::find_variant("jps")->make()->plan(problem, is_interrupted);
  return plan.outcome == Outcome::kFound ? plan.length_m : 0.0;
}

/// Can another goal help?
bool is_helped_by_nearest(Outcome outcome) { return outcome == Outcome::kGoalBlocked || outcome == Outcome::kNoPath; }

/// The planner with the task's parameters.
std::unique_ptr<global_planner::Planner> made(const OfflineTask& task, const Variant& variant) {
  const auto set = task.parameters.find(variant.name);
  return set == task.parameters.end() ? variant.make() : variant.make(set->second);
}

}  // namespace

double OfflineTask::needed_clearance_m() const {
  return std::max({radius_m, geometry::reach_m(outline), safe_distance_m, preferred_clearance_m});
}

/// One planner after the other over all queries, so that what it keeps between queries helps it as in
/// its service.
OfflineResult plan_offline(const OfflineTask& task, const std::vector<const Variant*>& planners,
                           const grid::ClearanceField& clearance, const Interrupted& is_interrupted,
                           const std::function<void(const OfflineAnswer&)>& hears_answer) {
  OfflineResult result;
  const global_planner::Outline outline{task.outline, task.start_yaw_rad, task.goal_yaw_rad};
  const std::vector<Query>& queries = task.queries;

  for (const Variant* variant : planners) {
    Tally tally(variant->name);
    const std::unique_ptr<global_planner::Planner> planner = made(task, *variant);

    for (std::size_t i = 0; i < queries.size() && !is_interrupted(); ++i) {
      Problem problem = problem_of(task, *variant, clearance, queries[i]);
      Answer answer = ask(*planner, problem, outline);

      if (task.goes_to_nearest && is_helped_by_nearest(answer.plan.outcome)) {
        problem.goal_in_map = global_planner::nearest_reachable(problem, is_interrupted).value_or(problem.goal_in_map);
        answer = ask(*planner, problem, outline);
      }

      const double best_m = queries[i].optimum_m > 0.0 ? queries[i].optimum_m
                            : queries.size() == 1      ? optimum_m(problem, is_interrupted)
                                                       : 0.0;
      tally.add(answer, best_m);
      if (hears_answer) hears_answer({variant->name, i, answer, best_m});

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

}  // namespace aisle::lab
