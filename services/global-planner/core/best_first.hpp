#pragma once
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/neighbours.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/planner.hpp"
#include "services/global-planner/core/search_memory.hpp"

namespace aisle::global_planner {

/// What an evaluation may use; fixed for one search.
struct Ends {
  grid::Geometry geometry;
  grid::Cell start;
  grid::Cell goal;
  const Drivable& drivable;
};

/// What becomes of a cell that was expanded and is then reached at a lower cost.
enum class Closed {
  kReopen,   // expanded again: with an admissible evaluation the result is optimal
  kStay,     // left as it is, as the papers do: fewer expansions, paths that may be longer
};

/// The one search loop (Hart, Nilsson, Raphael 1968). A variant is an evaluation, a neighbour rule and a list of passes.
///
/// `Evaluation` offers `begin(const Ends&)`, called before each search, and `operator()(cost, cell)`: the rank of a cell reached
/// at `cost`; both in units of kStraightCost a cell, at most 4e9. The lowest is expanded first; at the goal it must equal the cost.
template <class Evaluation>
class BestFirst final : public Planner {
 public:
  BestFirst(Closed closed, const NeighbourRule& rule, std::vector<Pass> passes)
      : closed_(closed), rule_(rule), passes_(std::move(passes)) {}

  void rest() override {
    nodes_.release();
    open_.release();
  }

 private:
  Plan search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    const grid::Geometry& geometry = drivable.geometry();
    const Ends ends{geometry, geometry.cell_at(problem.start_in_map), geometry.cell_at(problem.goal_in_map), drivable};
    Plan plan;
    plan.outcome = run(drivable, ends, out_of_time, plan.expanded);
    if (plan.outcome != Outcome::kFound) return plan;
    plan.waypoints_in_map = path(ends);
    plan.waypoints_in_map.front() = problem.start_in_map;
    plan.waypoints_in_map.back() = problem.goal_in_map;
    for (const Pass pass : passes_) pass(drivable, plan.waypoints_in_map);
    return plan;
  }

  Outcome run(const Drivable& drivable, const Ends& ends, const OutOfTime& out_of_time, std::size_t& expanded) {
    evaluation_.begin(ends);
    nodes_.begin(ends.geometry.cells());
    open_.begin();
    const auto start = static_cast<std::uint32_t>(ends.geometry.index(ends.start));
    const auto goal = static_cast<std::uint32_t>(ends.geometry.index(ends.goal));
    const auto width = static_cast<std::uint32_t>(ends.geometry.width);
    nodes_.reach(start, 0, 0);
    open_.push(evaluation_(0, ends.start), start, 0);
    bool found = false;
    BucketQueue::Entry entry;
    while (open_.pop(entry)) {
      if (found && open_.rank() > BucketQueue::rank_of(nodes_.cost(goal))) break;
      if (nodes_.is_closed(entry.cell) || nodes_.cost(entry.cell) != entry.cost) continue;   // stale
      if (expanded % 256 == 0 && out_of_time && out_of_time()) return found ? Outcome::kFound : Outcome::kOutOfTime;
      nodes_.close(entry.cell);
      const grid::Cell cell{static_cast<int>(entry.cell % width), static_cast<int>(entry.cell / width)};
      if (entry.cell == goal) {
        if (closed_ == Closed::kStay) return Outcome::kFound;
        found = true;   // and the rest of this bucket might lead there at a lower cost
        continue;
      }
      if (found && evaluation_(entry.cost, cell) >= nodes_.cost(goal)) continue;
      ++expanded;
      expand(drivable, ends.geometry, entry, cell);
    }
    return found ? Outcome::kFound : Outcome::kNoPath;
  }

  void expand(const Drivable& drivable, const grid::Geometry& geometry, const BucketQueue::Entry& entry, grid::Cell cell) {
    const unsigned allowed = rule_[traversable_neighbours(drivable, geometry, entry.cell, cell)];
    for (unsigned left = allowed; left != 0; left &= left - 1) {
      const int direction = __builtin_ctz(left);
      const Step& step = kSteps[static_cast<std::size_t>(direction)];
      const auto next = static_cast<std::uint32_t>(static_cast<std::int64_t>(entry.cell) + step.dy * static_cast<std::int64_t>(geometry.width) + step.dx);
      const std::uint32_t cost = entry.cost + step.cost;
      if (nodes_.is_known(next)) {
        if (cost >= nodes_.cost(next)) continue;
        if (closed_ == Closed::kStay && nodes_.is_closed(next)) continue;
      }
      nodes_.reach(next, cost, direction);
      open_.push(evaluation_(cost, {cell.x + step.dx, cell.y + step.dy}), next, cost);
    }
  }

  static unsigned traversable_neighbours(const Drivable& drivable, const grid::Geometry& geometry, std::size_t index, grid::Cell cell) {
    const bool is_inner = cell.x > 0 && cell.y > 0 && cell.x + 1 < geometry.width && cell.y + 1 < geometry.height;
    unsigned mask = 0;
    for (unsigned i = 0; i < kSteps.size(); ++i) {
      const grid::Cell next{cell.x + kSteps[i].dx, cell.y + kSteps[i].dy};
      const std::ptrdiff_t offset = kSteps[i].dy * static_cast<std::ptrdiff_t>(geometry.width) + kSteps[i].dx;
      const bool is_traversable = is_inner ? drivable.is_traversable(index + static_cast<std::size_t>(offset), next)
                                           : drivable.is_traversable(next);
      mask |= static_cast<unsigned>(is_traversable) << i;
    }
    return mask;
  }

  /// Centres of the cells from start to goal.
  std::vector<geometry::Point2> path(const Ends& ends) const {
    std::vector<geometry::Point2> points{ends.geometry.center_in_map(ends.goal)};
    for (grid::Cell cell = ends.goal; cell != ends.start;) {
      const Step& step = kSteps[static_cast<std::size_t>(nodes_.direction(ends.geometry.index(cell)))];
      cell = {cell.x - step.dx, cell.y - step.dy};
      points.push_back(ends.geometry.center_in_map(cell));
    }
    std::reverse(points.begin(), points.end());
    return points;
  }

  Closed closed_;
  const NeighbourRule& rule_;
  std::vector<Pass> passes_;
  Evaluation evaluation_;
  SearchNodes nodes_;
  BucketQueue open_;
};

template <class Evaluation>
std::unique_ptr<Planner> best_first(Closed closed, const NeighbourRule& rule, std::vector<Pass> passes) {
  return std::make_unique<BestFirst<Evaluation>>(closed, rule, std::move(passes));
}

}  // namespace aisle::global_planner
