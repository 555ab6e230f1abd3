#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/neighbours.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/planner.hpp"
#include "services/global-planner/core/search_memory.hpp"
#include "services/global-planner/core/surroundings.hpp"

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
  kReopen,  // expanded again: with an admissible evaluation the result is optimal
  kStay,    // left as it is, as the papers do: fewer expansions, paths that may be longer
};

/// Which steps are tried from a cell.
enum class Looks {
  kAround,  // all that the neighbour rule allows, as the papers do
  kAhead,   // without those that a cell's parent covers, see StepTable: for exact searches with kReopen and
            // kDrivableDiagonals
};

/// The one search loop: best-first search (Hart, Nilsson, Raphael, "A Formal Basis for the Heuristic Determination of
/// Minimum Cost Paths", 1968). A variant is an evaluation, a neighbour rule and a list of passes.
///
/// `Evaluation` offers `begin(const Ends&)`, called before each search, and `operator()(cost, cell)`: the rank of a
/// cell reached at `cost`; both in units of kStraightCost a cell, at most 4e9. The lowest rank is expanded first; at
/// the goal it must equal the cost.
template <class Evaluation>
class BestFirst final : public Planner {
 public:
  BestFirst(Closed closed, const NeighbourRule& rule, std::vector<Pass> passes, Looks looks, Evaluation evaluation = {})
      : closed_(closed),
        steps_(rule, looks == Looks::kAround),
        passes_(std::move(passes)),
        evaluation_(std::move(evaluation)) {}

  void rest() override {
    nodes_.release();
    open_.release();
  }

 private:
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    const grid::Geometry& geometry = drivable.geometry();
    const Ends ends{geometry, geometry.cell_at(problem.start_in_map), geometry.cell_at(problem.goal_in_map), drivable};

    PlannedPath plan = blank();
    plan.outcome = run(drivable, ends, out_of_time, plan.expanded);
    if (plan.outcome != Outcome::kFound) return plan;

    trace(ends, plan.waypoints_in_map);
    plan.waypoints_in_map.front() = problem.start_in_map;
    plan.waypoints_in_map.back() = problem.goal_in_map;

    for (const Pass pass : passes_) pass(drivable, plan.waypoints_in_map);

    return plan;
  }

  /// Expands cells until the goal is: at once, or, when closed cells may be reopened, until no cheaper way is left.
  Outcome run(const Drivable& drivable, const Ends& ends, const OutOfTime& out_of_time, std::size_t& expanded) {
    evaluation_.begin(ends);
    nodes_.begin(ends.geometry.cells());
    open_.begin();

    const auto start = static_cast<std::uint32_t>(ends.geometry.index(ends.start));
    const auto goal = static_cast<std::uint32_t>(ends.geometry.index(ends.goal));
    const auto width = static_cast<std::uint32_t>(ends.geometry.width);
    const Surroundings around(drivable);

    nodes_.reach(start, 0, 0);
    open_.push(evaluation_(0, ends.start), start, 0);

    std::uint32_t found_cost = kNotFound;  // of the goal, once it was expanded
    std::uint32_t found_rank = found_cost;

    BucketQueue::Entry entry;

    while (open_.pop(entry)) {
      if (open_.rank() > found_rank) break;
      if (nodes_.is_closed(entry.cell) || nodes_.cost(entry.cell) != entry.cost) continue;  // stale

      if (expanded % 256 == 0 && out_of_time && out_of_time())
        return found_rank != kNotFound ? Outcome::kFound : Outcome::kOutOfTime;

      nodes_.close(entry.cell);

      if (entry.cell == goal) {
        if (closed_ == Closed::kStay) return Outcome::kFound;
        found_cost = entry.cost;  // and the rest of this bucket might lead there at a lower cost
        found_rank = BucketQueue::rank_of(found_cost);
        continue;
      }

      const std::uint32_t y = entry.cell / width;
      const grid::Cell cell{static_cast<int>(entry.cell - y * width), static_cast<int>(y)};
      if (found_rank != kNotFound && evaluation_(entry.cost, cell) >= found_cost) continue;

      ++expanded;

      const std::size_t led_here =
          entry.cell == start ? StepTable::kStart : static_cast<std::size_t>(nodes_.direction(entry.cell));
      expand(width, entry, cell, steps_.steps(led_here, around.nine(entry.cell, cell)));
    }

    return found_rank != kNotFound ? Outcome::kFound : Outcome::kNoPath;
  }

  /// Reaches the cells that these steps lead to more cheaply than before.
  void expand(std::uint32_t width, const BucketQueue::Entry& entry, grid::Cell cell, unsigned steps) {
    for (unsigned left = steps; left != 0; left &= left - 1) {
      const int direction = __builtin_ctz(left);
      const Step& step = kSteps[static_cast<std::size_t>(direction)];

      const std::uint32_t next = entry.cell + static_cast<std::uint32_t>(step.dy) * width +
                                 static_cast<std::uint32_t>(step.dx);  // modulo 2^32

      const std::uint32_t cost = entry.cost + step.cost;

      if (cost >= nodes_.known_cost(next)) continue;
      if (closed_ == Closed::kStay && nodes_.is_known(next) && nodes_.is_closed(next)) continue;

      nodes_.reach(next, cost, direction);
      open_.push(evaluation_(cost, {cell.x + step.dx, cell.y + step.dy}), next, cost);
    }
  }

  /// Centres of the cells from start to goal, by the steps that led to each.
  void trace(const Ends& ends, std::vector<geometry::Point2>& points) const {
    points.clear();
    points.push_back(ends.geometry.center_in_map(ends.goal));

    for (grid::Cell cell = ends.goal; cell != ends.start;) {
      const Step& step = kSteps[static_cast<std::size_t>(nodes_.direction(ends.geometry.index(cell)))];
      cell = {cell.x - step.dx, cell.y - step.dy};
      points.push_back(ends.geometry.center_in_map(cell));
    }

    std::reverse(points.begin(), points.end());
  }

  static constexpr std::uint32_t kNotFound = std::numeric_limits<std::uint32_t>::max();

  Closed closed_;
  StepTable steps_;
  std::vector<Pass> passes_;
  Evaluation evaluation_;
  SearchNodes nodes_;
  BucketQueue open_;
};

/// A planner of this evaluation.
template <class Evaluation>
std::unique_ptr<Planner> best_first(Closed closed, const NeighbourRule& rule, std::vector<Pass> passes,
                                    Looks looks = Looks::kAround) {
  return std::make_unique<BestFirst<Evaluation>>(closed, rule, std::move(passes), looks);
}

}  // namespace aisle::global_planner
