// What a search allocates: counted by replacing this program's operator new.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <random>
#include <string>

#include "services/global-planner/core/variant.hpp"
#include "tests/support/sanitized.hpp"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

#pragma GCC diagnostic ignored "-Wmismatched-new-delete"  // GCC inlines one of the pair and not the other
void* operator new(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {  // of std::stable_sort
  ++allocations;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace aisle::global_planner {
namespace {

grid::OccupancyGrid scattered(unsigned seed) {
  grid::OccupancyGrid grid({120, 90, 0.1, {}});
  std::mt19937 random(seed);
  for (int i = 0; i < 1500; ++i) {
    grid.set({std::uniform_int_distribution<int>(1, 118)(random), std::uniform_int_distribution<int>(1, 88)(random)},
             grid::Occupancy::kOccupied);
  }
  return grid;
}

class Memory : public ::testing::TestWithParam<std::string> {};

TEST_P(Memory, OfAQueryIsAllocatedByTheFirstOne) {
  const grid::OccupancyGrid grid = scattered(5);
  const grid::ClearanceField clearance(grid, 2.0);
  const auto planner = find_variant(GetParam())->make();
  const grid::Geometry& g = grid.geometry();
  const Problem there{clearance, g.center_in_map({0, 0}), g.center_in_map({119, 89})};
  const Problem back{clearance, g.center_in_map({119, 89}), g.center_in_map({0, 0})};
  PlannedPath plan;
  for (const Problem& problem : {there, back}) {
    planner->plan(problem, nullptr, plan);
    ASSERT_EQ(plan.outcome, Outcome::kFound);
  }
  const std::size_t before = allocations;
  for (const Problem& problem : {there, back, there}) planner->plan(problem, nullptr, plan);
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(plan.outcome, Outcome::kFound);
}

TEST_P(Memory, IsGivenBackAtRestAndTheNextAnswerIsTheSame) {
  const grid::OccupancyGrid grid = scattered(6);
  const grid::ClearanceField clearance(grid, 2.0);
  const auto planner = find_variant(GetParam())->make();
  const grid::Geometry& g = grid.geometry();
  const Problem problem{clearance, g.center_in_map({0, 0}), g.center_in_map({119, 89})};
  const PlannedPath before = planner->plan(problem, nullptr);
  planner->rest();
  const PlannedPath after = planner->plan(problem, nullptr);
  EXPECT_EQ(after.outcome, Outcome::kFound);
  EXPECT_EQ(after.waypoints_in_map, before.waypoints_in_map);
  EXPECT_EQ(after.expanded, before.expanded);
}

INSTANTIATE_TEST_SUITE_P(Searches, Memory,
                         ::testing::Values("astar", "dijkstra", "direct", "greedy", "jps", "li", "modified-astar", "qu",
                                           "wang", "wu", "yu"),
                         [](const auto& tested) {
                           return tested.param == "modified-astar" ? std::string("modified_astar") : tested.param;
                         });

double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

class BytesACell : public ::testing::TestWithParam<std::string> {};

TEST_P(BytesACell, AreAtMostSixteenAfterAQueryAcrossTheMap) {
  if (test_support::kSanitized) GTEST_SKIP() << "a sanitizer's heap does not say how full it is";
  grid::OccupancyGrid grid({1200, 1000, 0.05, {}});
  std::mt19937 random(7);
  for (int i = 0; i < 60000; ++i) {
    grid.set({std::uniform_int_distribution<int>(1, 1198)(random), std::uniform_int_distribution<int>(1, 998)(random)},
             grid::Occupancy::kOccupied);
  }
  const grid::Geometry& g = grid.geometry();
  const grid::ClearanceField clearance(grid, 0.5);
  const auto planner = find_variant(GetParam())->make();
  const double before = heap_bytes();
  PlannedPath plan;
  planner->plan({clearance, g.center_in_map({0, 0}), g.center_in_map({1199, 999})}, nullptr, plan);
  const double taken = heap_bytes() - before;
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_LE(taken / static_cast<double>(g.cells()), 16.0);
  EXPECT_GT(taken / static_cast<double>(g.cells()), 4.0) << "the measure itself";
  planner->rest();
  EXPECT_LT((heap_bytes() - before) / static_cast<double>(g.cells()), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Searches, BytesACell, ::testing::Values("astar", "dijkstra", "direct", "jps", "wang"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace aisle::global_planner
