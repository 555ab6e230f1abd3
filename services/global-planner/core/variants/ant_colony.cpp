// Ant colony, LI's comparator (its table V), row G9; after Dorigo, Gambardella 1997. Ants walk from the start to the
// goal, drawn by pheromone and by steps that lengthen the way least; dead ends are walked back. The best walk of all
// marks its cells anew each round. An ant that has walked back to the start has seen all there is: then there is no
// path. The draws are the same for each query.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/open_steps.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

constexpr std::size_t kMostSteps = 400000;  // of all ants together; the first may take as many as it needs

struct Colony {
  int rounds;
  int ants;           // a round
  float evaporation;  // a round
  float greed;        // a step that lengthens the way by a cell is e^greed times less likely
  std::uint32_t seed;
};

Colony colony_of(Parameters& parameters) {
  return {static_cast<int>(parameters.number("rounds", 15.0, 1.0, 1000.0, "of all ants")),
          static_cast<int>(parameters.number("ants", 8.0, 1.0, 1000.0, "a round")),
          static_cast<float>(parameters.number("evaporation", 0.2, 0.0, 1.0, "of the pheromone, a round")),
          static_cast<float>(parameters.number("greed", 2.0, 0.0, 20.0,
                                               "a step that lengthens the way by a cell is e^greed times less likely")),
          static_cast<std::uint32_t>(parameters.number("seed", 9.0, 0.0, 1e9, "of the ants' draws"))};
}

using Walk = std::vector<grid::Cell>;

class AntColony final : public Planner {
 public:
  explicit AntColony(const Colony& colony) : colony_(colony) {}
  void rest() override { *this = AntColony(colony_); }

 private:
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    const grid::Geometry& geometry = drivable.geometry();
    start_ = geometry.cell_at(problem.start_in_map);
    goal_ = geometry.cell_at(problem.goal_in_map);
    pheromone_.assign(geometry.cells(), 1.0F);
    place_in_walk_.assign(geometry.cells(), kNowhere);
    random_.seed(colony_.seed);
    PlannedPath plan;
    plan.outcome = send_ants(drivable, out_of_time, plan.expanded);
    if (plan.outcome != Outcome::kFound) return plan;
    for (const grid::Cell cell : best_) plan.waypoints_in_map.push_back(geometry.center_in_map(cell));
    plan.waypoints_in_map.front() = problem.start_in_map;
    plan.waypoints_in_map.back() = problem.goal_in_map;
    passes::collinear(drivable, plan.waypoints_in_map);
    return plan;
  }

  Outcome send_ants(const Drivable& drivable, const OutOfTime& out_of_time, std::size_t& steps) {
    best_.clear();
    best_cost_ = 0;
    for (int round = 0; round < colony_.rounds; ++round) {
      for (int ant = 0; ant < colony_.ants; ++ant) {
        const Outcome outcome = walk(drivable, out_of_time, steps);
        if (outcome == Outcome::kNoPath) return outcome;
        if (outcome == Outcome::kOutOfTime) return best_.empty() ? outcome : Outcome::kFound;
        keep_if_better(drivable);
        if (steps > kMostSteps) return Outcome::kFound;
      }
      mark_best(drivable.geometry());
    }
    return Outcome::kFound;
  }

  /// One ant; its walk is left in walk_, without what it walked back.
  Outcome walk(const Drivable& drivable, const OutOfTime& out_of_time, std::size_t& steps) {
    const grid::Geometry& geometry = drivable.geometry();
    forget_walk(geometry);
    walk_.push_back(start_);
    seen_.push_back(start_);
    place_in_walk_[geometry.index(start_)] = 0;
    while (walk_.back() != goal_) {
      if (steps++ % 256 == 0 && out_of_time && out_of_time()) return Outcome::kOutOfTime;
      const int direction = choose(drivable, walk_.back());
      if (direction < 0) {
        place_in_walk_[geometry.index(walk_.back())] = kLeft;
        walk_.pop_back();
        if (walk_.empty()) return Outcome::kNoPath;
        continue;
      }
      const Step& step = kSteps[static_cast<std::size_t>(direction)];
      const grid::Cell next{walk_.back().x + step.dx, walk_.back().y + step.dy};
      place_in_walk_[geometry.index(next)] = static_cast<std::int32_t>(walk_.size());
      walk_.push_back(next);
      seen_.push_back(next);
    }
    return Outcome::kFound;
  }

  void forget_walk(const grid::Geometry& geometry) {
    for (const grid::Cell cell : seen_) {
      if (geometry.contains(cell)) place_in_walk_[geometry.index(cell)] = kNowhere;
    }
    seen_.clear();
    walk_.clear();
  }

  /// A step to a cell that this ant has not seen, -1 when there is none.
  int choose(const Drivable& drivable, grid::Cell cell) {
    const auto here = static_cast<float>(octile(cell, goal_));
    std::array<float, 8> chance{};
    float all = 0.0F;
    int last = -1;
    for (unsigned left = open_steps(drivable, cell); left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const Step& step = kSteps[static_cast<std::size_t>(i)];
      const grid::Cell next{cell.x + step.dx, cell.y + step.dy};
      const std::size_t index = drivable.geometry().index(next);
      if (place_in_walk_[index] != kNowhere) continue;
      const float longer = (static_cast<float>(step.cost + octile(next, goal_)) - here) / kStraightCost;
      chance[static_cast<std::size_t>(i)] = pheromone_[index] * std::exp(-colony_.greed * longer);
      all += chance[static_cast<std::size_t>(i)];
      last = i;
    }
    float drawn = static_cast<float>(random_()) * (1.0F / 4294967296.0F) * all;
    for (int i = 0; i < last; ++i) {
      drawn -= chance[static_cast<std::size_t>(i)];
      if (drawn < 0.0F) return i;
    }
    return last;
  }

  /// Takes the loops out of the walk: from each cell on to the latest of its neighbours.
  void keep_if_better(const Drivable& drivable) {
    const grid::Geometry& geometry = drivable.geometry();
    Walk straight{walk_.front()};
    std::uint32_t cost = 0;
    for (std::int32_t at = 0; walk_[static_cast<std::size_t>(at)] != goal_;) {
      const grid::Cell cell = walk_[static_cast<std::size_t>(at)];
      std::int32_t latest = at;
      std::uint32_t step_cost = 0;
      for (unsigned left = open_steps(drivable, cell); left != 0; left &= left - 1) {
        const Step& step = kSteps[static_cast<std::size_t>(__builtin_ctz(left))];
        const std::int32_t place = place_in_walk_[geometry.index({cell.x + step.dx, cell.y + step.dy})];
        if (place <= latest) continue;
        latest = place;
        step_cost = step.cost;
      }
      at = latest;
      cost += step_cost;
      straight.push_back(walk_[static_cast<std::size_t>(at)]);
    }
    if (!best_.empty() && cost >= best_cost_) return;
    best_ = std::move(straight);
    best_cost_ = cost;
  }

  void mark_best(const grid::Geometry& geometry) {
    for (float& pheromone : pheromone_) pheromone = std::max(0.1F, (1.0F - colony_.evaporation) * pheromone);
    for (const grid::Cell cell : best_) pheromone_[geometry.index(cell)] += 1.0F;
  }

  static constexpr std::int32_t kNowhere = -1;
  static constexpr std::int32_t kLeft = -2;  // walked back

  Colony colony_;
  grid::Cell start_, goal_;
  std::vector<float> pheromone_;
  std::vector<std::int32_t> place_in_walk_;  // of each cell: its place in the ant's walk
  Walk walk_, seen_, best_;
  std::uint32_t best_cost_{0};
  std::mt19937 random_;
};

}  // namespace

Variant ant_colony() {
  return {"ant-colony", "G9: ants and pheromone, then collinear points; LI's comparator", false,
          [](Parameters& parameters) -> std::unique_ptr<Planner> {
            return std::make_unique<AntColony>(colony_of(parameters));
          }};
}

}  // namespace aisle::global_planner
