#include "tools/lab/planning/random_tables.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/planning/random_maps.hpp"
#include "tools/lab/planning/tally.hpp"

namespace aisle::lab {
namespace {

using global_planner::Outcome;
using global_planner::Problem;

constexpr unsigned kBlockMaps = 200;
constexpr int kAntsUpTo = 60;  // cells an edge: on larger maps ants walk for long and arrive nowhere near the optimum

/// A planner, and on how many maps it was strictly better than the baseline.
struct Contestant {
  std::string name;
  std::unique_ptr<global_planner::Planner> planner;
  Tally tally;
  int maps{0}, shorter{0}, straighter{0}, fewer_nodes{0}, fewer_expanded{0};
};

/// All planners but one that needs headings.
std::vector<Contestant> contestants() {
  std::vector<Contestant> all;
  for (const global_planner::Variant& variant : global_planner::all_variants()) {
    if (variant.name != "hybrid")
      all.push_back({variant.name, variant.make(), Tally(variant.name)});  // as theta without headings
  }

  return all;
}

/// Counts one map; `answer` and `astar` solve the same problem.
void compare(Contestant& contestant, const Answer& answer, const Answer& astar) {
  contestant.tally.add(answer, astar.figures.length_m);
  ++contestant.maps;
  contestant.shorter += answer.figures.length_m < astar.figures.length_m * (1.0 - 1e-9) ? 1 : 0;
  contestant.straighter += answer.figures.turning_points < astar.figures.turning_points ? 1 : 0;
  contestant.fewer_nodes += answer.figures.nodes < astar.figures.nodes ? 1 : 0;
  contestant.fewer_expanded += answer.plan.expanded < astar.plan.expanded ? 1 : 0;
}

/// "-" of nothing.
std::string percent(int part, int of) { return of == 0 ? "-" : digits(100.0 * part / of, 0) + " %"; }

/// 0 of nothing.
double quantile(std::vector<double> of, double part) {
  std::sort(of.begin(), of.end());
  return of.empty() ? 0.0
                    : of[std::min(of.size() - 1, static_cast<std::size_t>(part * static_cast<double>(of.size())))];
}

/// 20 x 20 cells of 1 m with 8 to 19 blocks.
grid::OccupancyGrid block_map(unsigned seed) {
  std::mt19937 random(seed);
  const int blocks = random_between(random, 8, 19);
  return random_blocks(random, 20, blocks, 4);
}

/// A paper's planner and its baseline.
struct Comparison {
  const char* planner;
  global_planner::Heuristic heuristic;
  global_planner::Moves moves;
};

constexpr Comparison kComparisons[] = {{"li", global_planner::Heuristic::kEuclidean, global_planner::Moves::kFour},
                                       {"wu", global_planner::Heuristic::kEuclidean, global_planner::Moves::kEight},
                                       {"qu", global_planner::Heuristic::kEuclidean, global_planner::Moves::kEight},
                                       {"yu", global_planner::Heuristic::kEuclidean, global_planner::Moves::kEight},
                                       {"wang", global_planner::Heuristic::kChebyshev, global_planner::Moves::kEight}};

}  // namespace

/// Only maps on which the paper's planner finds a path count.
std::string block_direction_table(const Progress& progress) {
  std::vector<std::vector<std::string>> table{
      {"planner", "from", "maps", "length", "shorter", "fewer turns", "fewer nodes", "fewer expanded"}};
  for (const Comparison& claim : kComparisons) {
    progress(std::string("block maps, directions: ") + claim.planner);

    Contestant from_drawn{"A* as drawn", global_planner::traditional_astar(claim.heuristic, claim.moves),
                          Tally(claim.planner)};
    Contestant from_drivable{"an A* that cuts no corner", global_planner::find_variant("astar")->make(),
                             Tally(claim.planner)};
    const auto planner = global_planner::find_variant(claim.planner)->make();

    for (unsigned seed = 1; seed <= kBlockMaps; ++seed) {
      const grid::ClearanceField clearance(block_map(seed), 20.0);
      const Problem problem{clearance, {0.5, 0.5}, {19.5, 19.5}};

      const Answer ours = ask(*planner, problem);
      if (ours.plan.outcome != Outcome::kFound) continue;

      for (Contestant* baseline : {&from_drawn, &from_drivable})
        compare(*baseline, ours, ask(*baseline->planner, problem));
    }

    for (const Contestant* c : {&from_drawn, &from_drivable}) {
      table.push_back({claim.planner, c->name, std::to_string(c->maps), digits(c->tally.length_ratio_mean(), 4),
                       percent(c->shorter, c->maps), percent(c->straighter, c->maps), percent(c->fewer_nodes, c->maps),
                       percent(c->fewer_expanded, c->maps)});
    }
  }

  return markdown_table(table);
}

/// Quartiles of 1 - expanded / expanded of the baseline.
std::string block_map_table(const Progress& progress) {
  std::vector<std::vector<std::string>> table{{"planner", "quarter", "median", "three quarters", "maps"}};
  const auto traditional = global_planner::traditional_astar(global_planner::Heuristic::kChebyshev);

  for (const global_planner::Variant& variant : global_planner::all_variants()) {
    progress("block maps: " + variant.name);

    const auto planner = variant.make();
    std::vector<double> fewer;

    for (unsigned seed = 1; seed <= kBlockMaps; ++seed) {
      const grid::ClearanceField clearance(block_map(seed), 20.0);
      const Problem problem{clearance, {0.5, 0.5}, {19.5, 19.5}};

      const global_planner::PlannedPath ours = planner->plan(problem, nullptr);
      if (ours.outcome != Outcome::kFound) continue;

      fewer.push_back(100.0 - 100.0 * static_cast<double>(ours.expanded) /
                                  static_cast<double>(traditional->plan(problem, nullptr).expanded));
    }

    table.push_back({variant.name, digits(quantile(fewer, 0.25), 1) + " %", digits(quantile(fewer, 0.5), 1) + " %",
                     digits(quantile(fewer, 0.75), 1) + " %", std::to_string(fewer.size())});
  }

  return markdown_table(table);
}

/// The seed follows from share and number, so that each map can be made again alone.
std::string random_map_table(int occupied_percent, int maps, const Progress& progress) {
  std::vector<Contestant> all = contestants();
  const auto astar = global_planner::find_variant("astar")->make();
  int solvable = 0;

  for (int i = 0; i < maps; ++i) {
    if (i % 50 == 0)
      progress("random maps, " + std::to_string(occupied_percent) + " %: " + std::to_string(i) + " of " +
               std::to_string(maps));

    std::mt19937 random(static_cast<unsigned>(occupied_percent * 100000 + i));
    const int edge = random_between(random, 20, 200);
    grid::OccupancyGrid grid = random_cells(random, edge, edge, occupied_percent);

    grid.set({0, 0}, grid::Occupancy::kFree);
    grid.set({edge - 1, edge - 1}, grid::Occupancy::kFree);

    const grid::ClearanceField clearance(grid, 5.0);
    const Problem problem{clearance, {0.5, 0.5}, {edge - 0.5, edge - 0.5}};

    const Answer baseline = ask(*astar, problem);
    if (baseline.plan.outcome != Outcome::kFound) continue;

    ++solvable;

    for (Contestant& contestant : all) {
      if (contestant.name == "ant-colony" && edge > kAntsUpTo) continue;
      compare(contestant, ask(*contestant.planner, problem), baseline);
    }
  }

  std::vector<std::vector<std::string>> table{{"planner", "maps", "faults", "length/optimum", "p99", "turns", "nodes",
                                               "expanded", "p99", "shorter", "fewer turns", "fewer nodes",
                                               "fewer expanded"}};
  for (const Contestant& contestant : all) {
    const Tally& t = contestant.tally;
    table.push_back({contestant.name, std::to_string(t.solved()), std::to_string(t.checker_failures()),
                     digits(t.length_ratio_mean(), 4), digits(t.length_ratio_p99(), 4),
                     digits(t.turning_points_mean(), 1), digits(t.nodes_mean(), 1), digits(t.expanded_mean(), 0),
                     digits(t.expanded_p99(), 0), percent(contestant.shorter, contestant.maps),
                     percent(contestant.straighter, contestant.maps), percent(contestant.fewer_nodes, contestant.maps),
                     percent(contestant.fewer_expanded, contestant.maps)});
  }

  return std::to_string(solvable) + " of " + std::to_string(maps) + " maps have a path; seeds " +
         std::to_string(occupied_percent * 100000) + " to " + std::to_string(occupied_percent * 100000 + maps - 1) +
         ".\n\n" + markdown_table(table);
}

}  // namespace aisle::lab
