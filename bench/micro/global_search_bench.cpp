// Every planner variant, and a textbook A* beside them, on the same 100 queries of the shipped warehouse.

#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "bench/peers/textbook_astar.hpp"
#include "common/grid/formats/map_file.hpp"
#include "services/global-planner/core/variant.hpp"

namespace {

using namespace aisle;

struct Query {
  grid::Cell start, goal;
};

/// Random pairs that have a way, the same for every planner.
struct Queries {
  grid::OccupancyGrid grid = grid::read_map_file(AISLE_BENCH_MAP);
  grid::ClearanceField clearance{grid, 2.0};
  std::vector<Query> list;

  Queries() {
    const grid::Geometry& geometry = grid.geometry();
    std::mt19937 random(11);
    std::uniform_int_distribution<int> x(0, geometry.width - 1);
    std::uniform_int_distribution<int> y(0, geometry.height - 1);

    while (list.size() < 100) {
      const Query query{{x(random), y(random)}, {x(random), y(random)}};
      if (!grid.is_free(query.start) || !grid.is_free(query.goal)) continue;
      if (bench::textbook_astar(grid, query.start, query.goal).is_found) list.push_back(query);
    }
  }
};

const Queries& queries() {
  static const Queries all;
  return all;
}

void textbook(benchmark::State& state) {
  std::size_t next = 0;
  for (auto _ : state) {
    const Query& query = queries().list[next++ % queries().list.size()];
    benchmark::DoNotOptimize(bench::textbook_astar(queries().grid, query.start, query.goal));
  }
}

BENCHMARK(textbook)->Unit(benchmark::kMicrosecond);

/// One iteration asks all queries. A planner that finds no path where the textbook finds one is an
/// error.
void search(benchmark::State& state, const global_planner::Variant& variant) {
  const std::unique_ptr<global_planner::Planner> planner = variant.make();
  const grid::Geometry& geometry = queries().grid.geometry();
  const global_planner::OutOfTime never = [] { return false; };
  std::size_t next = 0;
  double expanded = 0.0;

  for (auto _ : state) {
    const Query& query = queries().list[next++ % queries().list.size()];
    const global_planner::PlannedPath plan = planner->plan(
        {queries().clearance, geometry.center_in_map(query.start), geometry.center_in_map(query.goal), 0.0}, never);
    if (plan.outcome != global_planner::Outcome::kFound)
      throw std::runtime_error(variant.name + ": no path where the textbook finds one");

    expanded += static_cast<double>(plan.expanded);
  }

  state.counters["expanded"] = benchmark::Counter(expanded, benchmark::Counter::kAvgIterations);
}

/// A benchmark for each variant, under its name.
const bool registered = [] {
  for (const global_planner::Variant& variant : global_planner::all_variants()) {
    benchmark::RegisterBenchmark(variant.name.c_str(), [&variant](benchmark::State& state) {
      search(state, variant);
    })->Unit(benchmark::kMicrosecond);
  }

  return true;
}();

}  // namespace
