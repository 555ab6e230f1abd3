#include "tools/lab/traffic_bounds/pibt_bound.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace aisle::lab {
namespace {

/// Vehicles on their way, with the steps to the goal that each has now.
class Progress {
 public:
  Progress(const StepGraph& graph, const PibtFleet& fleet)
      : graph_(graph), fleet_(fleet), reached_(fleet.starts.size(), 0), since_(fleet.starts.size(), 0) {
    for (std::size_t i = 0; i < fleet.starts.size(); ++i) tables_.push_back(steps_to(graph, goal_of(i)));
  }

  /// Vehicles that stand at their goals get the next ones. @return how many goals were reached
  std::uint64_t serve(const std::vector<Vertex>& at, std::uint64_t step) {
    std::uint64_t count = 0;

    for (std::size_t i = 0; i < at.size(); ++i) {
      while (is_on_way(i) && at[i] == goal_of(i)) {
        ++reached_[i];
        ++count;
        since_[i] = step;
        tables_[i] = steps_to(graph_, goal_of(i));
      }
    }

    return count;
  }

  /// The longest on its way first; those without a goal last.
  std::vector<std::size_t> order() const {
    std::vector<std::size_t> order(since_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      if (is_on_way(a) != is_on_way(b)) return is_on_way(a);
      return since_[a] < since_[b];
    });
    return order;
  }

  std::vector<const StepTable*> to_go() const {
    std::vector<const StepTable*> to_go;
    for (const StepTable& table : tables_) to_go.push_back(&table);
    return to_go;
  }

 private:
  bool is_on_way(std::size_t i) const { return reached_[i] < fleet_.goals[i].size(); }

  /// Its last goal, or its start, for a vehicle that has reached all.
  Vertex goal_of(std::size_t i) const {
    const std::vector<Vertex>& goals = fleet_.goals[i];
    return goals.empty() ? fleet_.starts[i] : goals[std::min(reached_[i], goals.size() - 1)];
  }

  const StepGraph& graph_;
  const PibtFleet& fleet_;
  std::vector<std::size_t> reached_;
  std::vector<std::uint64_t> since_;
  std::vector<StepTable> tables_;
};

}  // namespace

double PibtRun::steps_a_goal(std::size_t vehicles) const {
  if (goals == 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(steps) * static_cast<double>(vehicles) / static_cast<double>(goals);
}

PibtRun run_pibt(const StepGraph& graph, const PibtFleet& fleet, std::uint64_t steps, std::uint64_t seed,
                 const std::function<void(const std::vector<Vertex>&)>& watch) {
  PibtRun run;
  PibtStep pibt(graph, seed);
  Progress progress(graph, fleet);
  std::vector<Vertex> at = fleet.starts;

  run.goals += progress.serve(at, 0);
  if (watch) watch(at);

  for (; run.steps < steps; ++run.steps) {
    std::vector<Vertex> next(at.size(), kNoVertex);
    pibt.plan(at, progress.order(), progress.to_go(), next);

    at = std::move(next);
    run.goals += progress.serve(at, run.steps + 1);
    if (watch) watch(at);
  }

  return run;
}

double goals_per_vehicle_hour(double steps_a_goal, double step_s, double pause_s) {
  return 3600.0 / (step_s * steps_a_goal + pause_s);
}

}  // namespace aisle::lab
