// Is repairing a search after a map edit worth it? For each map: plan, block a box of 1 m (at least 3 cells) in the
// middle of the path, plan again; then free it, plan again. Beside a fresh A* and a fresh jump point search stands
// LPA*, D* Lite's search for a vehicle that stands (Koenig, Likhachev 2002), which repairs what it knows. Times of
// planning alone; the clearance field's update is the same for all. usage: replan DATA_FOLDER [QUERIES]     prints a
// table, medians in microseconds

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/grid/formats/map_file.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/open_steps.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/queries.hpp"

namespace {

using namespace aisle;
using namespace aisle::global_planner;

constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max() / 4;

/// Lifelong planning A* (Koenig, Likhachev, Furcy 2004) from the goal to the start, with 8 bytes a cell
/// beside the queue: `known` is the paper's g, `ahead` its rhs, and a cell is in the queue where they
/// differ.
class LifelongPlanning {
 public:
  /// The goal's rhs is 0; everything else is infinitely far.
  LifelongPlanning(const Drivable& drivable, grid::Cell start, grid::Cell goal)
      : drivable_(&drivable),
        geometry_(drivable.geometry()),
        start_(start),
        goal_(goal),
        values_(geometry_.cells(), {kNever, kNever}) {
    values_[geometry_.index(goal)].ahead = 0;
    push(goal);
  }

  /// Cost from the start to the goal, kNever when there is no way.
  std::uint32_t search() {
    const std::size_t start = geometry_.index(start_);
    while (!open_.empty()) {
      const Open top = open_.top();
      const Key at_start = key(start_);
      if (!(top.key < at_start) && values_[start].ahead == values_[start].known) break;

      open_.pop();

      const std::size_t index = geometry_.index(top.cell);
      Value& value = values_[index];
      if (value.known == value.ahead || !(top.key == key(top.cell))) continue;  // stale

      // Overconsistent: g becomes rhs. Underconsistent: g becomes infinite, and the cell is looked at
      // anew.
      const bool gets_cheaper = value.known > value.ahead;
      value.known = gets_cheaper ? value.ahead : kNever;
      if (!gets_cheaper) update(top.cell);

      for (const Step& step : kSteps) {
        const grid::Cell next{top.cell.x + step.dx, top.cell.y + step.dy};
        if (geometry_.contains(next)) update(next);
      }
    }

    return values_[start].known;
  }

  /// The costs between these cells and their neighbours are computed anew; search() then repairs what
  /// follows from them.
  void cells_changed(const Drivable& drivable, grid::Cell low, grid::Cell high) {
    drivable_ = &drivable;

    for (int y = low.y - 1; y <= high.y + 1; ++y) {
      for (int x = low.x - 1; x <= high.x + 1; ++x) {
        if (geometry_.contains({x, y})) update({x, y});
      }
    }
  }

 private:
  struct Value {
    std::uint32_t known, ahead;  // g and rhs
  };

  struct Key {
    std::uint32_t through, cost;

    bool operator<(const Key& o) const { return through != o.through ? through < o.through : cost < o.cost; }
    bool operator==(const Key& o) const { return through == o.through && cost == o.cost; }
  };

  struct Open {
    Key key;
    grid::Cell cell;

    bool operator<(const Open& o) const { return o.key < key; }
  };

  /// [min(g, rhs) + h; min(g, rhs)]
  Key key(grid::Cell cell) const {
    const Value& value = values_[geometry_.index(cell)];
    const std::uint32_t least = std::min(value.known, value.ahead);
    return {least >= kNever ? kNever : least + octile(cell, start_), least};
  }

  void push(grid::Cell cell) { open_.push({key(cell), cell}); }

  /// rhs(s) = min over neighbours n of cost(s, n) + g(n)
  void update(grid::Cell cell) {
    Value& value = values_[geometry_.index(cell)];
    if (cell != goal_) {
      value.ahead = kNever;

      const unsigned steps = drivable_->is_traversable(cell) ? open_steps(*drivable_, cell) : 0;
      for (unsigned left = steps; left != 0; left &= left - 1) {
        const Step& step = kSteps[static_cast<std::size_t>(__builtin_ctz(left))];
        const std::uint32_t there = values_[geometry_.index({cell.x + step.dx, cell.y + step.dy})].known;
        if (there < kNever) value.ahead = std::min(value.ahead, there + step.cost);
      }
    }

    if (value.known != value.ahead) push(cell);
  }

  const Drivable* drivable_;
  grid::Geometry geometry_;
  grid::Cell start_, goal_;
  std::vector<Value> values_;
  std::priority_queue<Open> open_;
};

/// How long `work` takes.
template <class Work>
double microseconds(const Work& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

double median(std::vector<double> of) {
  if (of.empty()) return 0.0;
  std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2), of.end());
  return of[of.size() / 2];
}

/// Microseconds: fresh A*, fresh jump points, the first lifelong search, and its repair.
struct Times {
  std::vector<double> astar, jps, first, repair;
};

/// Blocks a square in the middle of the path, then frees it; after each edit all three plan, and their
/// lengths must agree.
void edit_and_plan(grid::OccupancyGrid& grid, grid::ClearanceField& clearance, const lab::Query& query, Times& times) {
  const auto astar = find_variant("astar")->make();
  const auto jps = find_variant("jps")->make();
  const grid::Geometry& geometry = grid.geometry();
  const Problem problem{clearance, query.start_in_map, query.goal_in_map};
  const PlannedPath before = astar->plan(problem, nullptr);
  if (jps->plan(problem, nullptr).outcome != Outcome::kFound || before.waypoints_in_map.size() < 20) return;

  const Drivable drivable(problem);
  LifelongPlanning lifelong(drivable, geometry.cell_at(query.start_in_map), geometry.cell_at(query.goal_in_map));

  times.first.push_back(microseconds([&] { lifelong.search(); }));

  // A square of a metre on the middle of the path.
  const grid::Cell middle = geometry.cell_at(before.waypoints_in_map[before.waypoints_in_map.size() / 2]);
  const int half = std::max(1, static_cast<int>(0.5 / geometry.resolution_m));
  const grid::Cell low{std::max(0, middle.x - half), std::max(0, middle.y - half)};
  const grid::Cell high{std::min(geometry.width - 1, middle.x + half), std::min(geometry.height - 1, middle.y + half)};
  std::vector<grid::Cell> blocked;

  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (grid.is_free({x, y})) blocked.push_back({x, y});
    }
  }

  for (const bool block : {true, false}) {
    for (const grid::Cell c : blocked) grid.set(c, block ? grid::Occupancy::kOccupied : grid::Occupancy::kFree);
    clearance.update(grid, low, high);

    PlannedPath fresh, jumped;
    std::uint32_t repaired = kNever;
    const Drivable edited(problem);

    times.astar.push_back(microseconds([&] { fresh = astar->plan(problem, nullptr); }));
    times.jps.push_back(microseconds([&] { jumped = jps->plan(problem, nullptr); }));

    times.repair.push_back(microseconds([&] {
      lifelong.cells_changed(edited, low, high);
      repaired = lifelong.search();
    }));

    const double repaired_m = repaired >= kNever ? 0.0 : repaired * geometry.resolution_m / kStraightCost;
    if (std::abs(repaired_m - fresh.length_m) + std::abs(jumped.length_m - fresh.length_m) >
        1e-5 * fresh.length_m + 1e-6)
      throw std::runtime_error("the repaired search is not optimal");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: replan DATA_FOLDER [QUERIES]\n");
    return 2;
  }

  const std::filesystem::path data = argv[1];
  const auto limit = static_cast<std::size_t>(argc > 2 ? std::max(1, std::atoi(argv[2])) : 20);

  std::printf("%-24s %10s %10s %10s %10s %14s\n", "map", "fresh A*", "fresh jps", "LPA* first", "LPA* again",
              "again / jps");

  for (const char* map :
       {"movingai/warehouse-10-20-10-2-1.map", "movingai/room-64-64-16.map", "movingai/random-64-64-20.map",
        "movingai/maze-128-128-10.map", "movingai/den520d.map", "movingai/Berlin_1_256.map", "ros/willow-full.yaml",
        "ros/nav2_depot.yaml", "ros/nav2_warehouse.yaml"}) {
    const std::filesystem::path file = data / map;
    grid::OccupancyGrid grid = grid::read_map_file(file);
    grid::ClearanceField clearance(grid, 2.0);
    Times times;

    for (const lab::Query& query :
         lab::read_queries(data / "queries" / (file.stem().string() + ".q"), grid.geometry(), limit)) {
      edit_and_plan(grid, clearance, query, times);
    }

    std::printf("%-24s %10.1f %10.1f %10.1f %10.1f %14.2f\n", file.stem().c_str(), median(times.astar),
                median(times.jps), median(times.first), median(times.repair), median(times.repair) / median(times.jps));
  }

  return 0;
}
