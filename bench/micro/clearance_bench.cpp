// The clearance field of a whole map, and of the window that an edit of 1 m can change. 1000 x 1000 cells of 0.05 m, a
// tenth of them blocked.

#include <benchmark/benchmark.h>

#include <random>

#include "common/grid/clearance.hpp"

namespace {

using namespace aisle;

/// A thousand blocks of half a metre.
grid::OccupancyGrid scattered_blocks() {
  grid::OccupancyGrid grid(grid::Geometry{1000, 1000, 0.05, {}});
  std::mt19937 random(7);
  std::uniform_int_distribution<int> at(0, 989);

  for (int block = 0; block < 1000; ++block) {
    const grid::Cell low{at(random), at(random)};
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 10; ++x) grid.set({low.x + x, low.y + y}, grid::Occupancy::kOccupied);
    }
  }

  return grid;
}

void whole_map(benchmark::State& state) {
  const grid::OccupancyGrid grid = scattered_blocks();
  for (auto _ : state) benchmark::DoNotOptimize(grid::ClearanceField(grid, 2.0));
}

BENCHMARK(whole_map)->Unit(benchmark::kMillisecond);

void after_an_edit_of_1_m(benchmark::State& state) {
  grid::OccupancyGrid grid = scattered_blocks();
  grid::ClearanceField field(grid, 2.0);
  const grid::Cell low{490, 490};
  const grid::Cell high{509, 509};
  bool block = true;

  for (auto _ : state) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x)
        grid.set({x, y}, block ? grid::Occupancy::kOccupied : grid::Occupancy::kFree);
    }

    field.update(grid, low, high);
    block = !block;
  }
}

BENCHMARK(after_an_edit_of_1_m)->Unit(benchmark::kMillisecond);

}  // namespace
