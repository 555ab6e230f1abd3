// One suite for all variants: a new file in core/variants is tested without a word here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <queue>
#include <random>
#include <vector>

#include "services/global-planner/core/nearest_reachable.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/planner.hpp"
#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/ascii_grid.hpp"
#include "tests/support/random_grid.hpp"

namespace aisle::global_planner {

void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

namespace {

using geometry::Point2;
using grid::Cell;
using test_support::find_letter;
using test_support::grid_from_text;

bool never() { return false; }

/// Dijkstra with a priority queue, written for this test alone: the least 8-connected length without cutting corners,
/// in metres; infinity when there is no way.
double shortest_m(const grid::ClearanceField& clearance, double radius_m, Cell start, Cell goal) {
  const grid::Geometry& g = clearance.geometry();
  const auto open = [&](int x, int y) { return g.contains({x, y}) && clearance.is_traversable({x, y}, radius_m); };
  std::vector<double> cost(g.cells(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  if (!open(start.x, start.y) || !open(goal.x, goal.y)) return std::numeric_limits<double>::infinity();
  cost[g.index(start)] = 0.0;
  queue.push({0.0, g.index(start)});
  while (!queue.empty()) {
    const auto [c, index] = queue.top();
    queue.pop();
    if (c > cost[index]) continue;
    const int x = static_cast<int>(index) % g.width;
    const int y = static_cast<int>(index) / g.width;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || !open(x + dx, y + dy) || !open(x + dx, y) || !open(x, y + dy)) continue;
        const double next = c + std::hypot(dx, dy) * g.resolution_m;
        double& known = cost[g.index({x + dx, y + dy})];
        if (next >= known) continue;
        known = next;
        queue.push({next, g.index({x + dx, y + dy})});
      }
    }
  }
  return cost[g.index(goal)];
}

class EveryVariant : public testing::TestWithParam<Variant> {
 protected:
  std::unique_ptr<Planner> planner_{GetParam().make()};
};

TEST_P(EveryVariant, AgreesWithDijkstraOnRandomGrids) {
  for (unsigned seed = 1; seed <= 400; ++seed) {
    std::mt19937 random(seed);
    const int width = test_support::random_between(random, 2, 40);
    const int height = test_support::random_between(random, 2, 40);
    const double resolution_m = seed % 2 == 0 ? 1.0 : 0.25;
    const grid::OccupancyGrid grid =
        test_support::random_cells(random, width, height, static_cast<int>(seed % 4) * 10, resolution_m);
    const grid::ClearanceField clearance(grid, 20.0);
    const Cell start{test_support::random_between(random, 0, width - 1),
                     test_support::random_between(random, 0, height - 1)};
    const Cell goal{test_support::random_between(random, 0, width - 1),
                    test_support::random_between(random, 0, height - 1)};
    const double radius_m = seed % 3 == 0 ? 0.9 * resolution_m : 0.0;
    SCOPED_TRACE("seed " + std::to_string(seed));

    const Problem problem{clearance, grid.geometry().center_in_map(start), grid.geometry().center_in_map(goal),
                          radius_m};
    const PlannedPath plan = planner_->plan(problem, never);
    const double optimum_m = shortest_m(clearance, radius_m, start, goal);
    if (plan.outcome != Outcome::kFound) {
      EXPECT_TRUE(std::isinf(optimum_m)) << "found nothing where there is a way of " << optimum_m << " m";
      EXPECT_TRUE(plan.waypoints_in_map.empty());
      continue;
    }
    ASSERT_FALSE(std::isinf(optimum_m));
    EXPECT_EQ(why_not_drivable(problem, plan.waypoints_in_map), "");
    EXPECT_NEAR(plan.length_m, path_length_m(plan.waypoints_in_map), 1e-9);
    if (GetParam().is_optimal) {
      EXPECT_NEAR(plan.length_m, optimum_m, 1e-5 * optimum_m);
    }
    if (GetParam().is_never_longer) {
      EXPECT_LE(plan.length_m, (1.0 + 1e-6) * optimum_m);
    }
  }
}

TEST_P(EveryVariant, KeepsARadiusOf30CentimetresBetweenRandomBlocks) {
  int found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(test_support::random_blocks(random, 120, 12, 12, 0.05), 2.0);
    for (int query = 0; query < 5; ++query) {
      const auto somewhere = [&] {
        return Point2{0.001 * test_support::random_between(random, 0, 5999),
                      0.001 * test_support::random_between(random, 0, 5999)};
      };
      const Problem problem{clearance, somewhere(), somewhere(), 0.3, query % 2 == 0 ? 0.15 : 1e9};
      const PlannedPath plan = planner_->plan(problem, never);
      if (plan.outcome != Outcome::kFound) continue;
      ++found;
      EXPECT_EQ(why_not_drivable(problem, plan.waypoints_in_map), "") << "seed " << seed << ", query " << query;
    }
  }
  EXPECT_GT(found, 20);
}

TEST_P(EveryVariant, GoesToTheNearestReachablePointWhenAsked) {
  const std::vector<std::string> text{"S.....", "...###", "...#G#", "...###"};
  const grid::ClearanceField clearance(grid_from_text(text), 10.0);
  const Problem problem{clearance, find_letter(text, 'S'), find_letter(text, 'G')};
  const PlannedPath plan = plan_to_nearest(*planner_, problem, never);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  const Point2 end = plan.waypoints_in_map.back();
  EXPECT_EQ(end, (Point2{2.5, 1.5}));
  const Problem reached{clearance, problem.start_in_map, end};
  EXPECT_EQ(why_not_drivable(reached, plan.waypoints_in_map), "");
  const Problem lost{clearance, {3.5, 2.5}, problem.goal_in_map};
  EXPECT_EQ(plan_to_nearest(*planner_, lost, never).outcome, Outcome::kStartBlocked);
}

TEST_P(EveryVariant, SaysThatAWalledInGoalHasNoPath) {
  const std::vector<std::string> text{"......", ".S.###", "...#G#", "...###"};
  const grid::ClearanceField clearance(grid_from_text(text), 10.0);
  const PlannedPath plan = planner_->plan({clearance, find_letter(text, 'S'), find_letter(text, 'G')}, never);
  EXPECT_EQ(plan.outcome, Outcome::kNoPath);
  EXPECT_TRUE(plan.waypoints_in_map.empty());
}

TEST_P(EveryVariant, CutsNoCornerAndSlipsThroughNoDiagonalGap) {
  const std::vector<std::string> text{"..#G", ".#..", "#...", "S..."};
  const std::vector<std::string> gap{"S#", "#G"};
  const grid::ClearanceField clearance(grid_from_text(text), 10.0);
  const Problem problem{clearance, find_letter(text, 'S'), find_letter(text, 'G')};
  const PlannedPath plan = planner_->plan(problem, never);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(why_not_drivable(problem, plan.waypoints_in_map), "");
  const grid::ClearanceField gap_clearance(grid_from_text(gap), 10.0);
  EXPECT_EQ(planner_->plan({gap_clearance, find_letter(gap, 'S'), find_letter(gap, 'G')}, never).outcome,
            Outcome::kNoPath);
}

TEST_P(EveryVariant, KeepsTheRadiusFromWalls) {
  const std::vector<std::string> text{"............", "S...####...G", "....####....", "............",
                                      "............", "............", "............"};
  const grid::ClearanceField clearance(grid_from_text(text), 10.0);
  const Problem problem{clearance, find_letter(text, 'S'), find_letter(text, 'G'), 0.5};
  Problem wide = problem;
  wide.radius_m = 1.4;
  EXPECT_EQ(planner_->plan(wide, never).outcome, Outcome::kStartBlocked);
  const PlannedPath plan = planner_->plan(problem, never);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(why_not_drivable(problem, plan.waypoints_in_map), "");
}

TEST_P(EveryVariant, StaysWhereItIsWhenTheGoalIsInTheSameCell) {
  const grid::ClearanceField clearance(grid_from_text({"...", "...", "..."}), 10.0);
  const PlannedPath plan = planner_->plan({clearance, {1.4, 1.5}, {1.6, 1.5}}, never);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_NEAR(plan.length_m, 0.2, 1e-12);
  EXPECT_EQ(planner_->plan({clearance, {1.5, 1.5}, {1.5, 1.5}}, never).length_m, 0.0);
}

TEST_P(EveryVariant, BeginsAndEndsAtTheExactPoints) {
  const grid::OccupancyGrid grid(grid::Geometry{60, 40, 0.1, {-2.0, 3.0}});
  const grid::ClearanceField clearance(grid, 2.0);
  const Problem problem{clearance, {-1.234, 4.321}, {3.033, 6.066}, 0.3};
  const PlannedPath plan = planner_->plan(problem, never);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(plan.waypoints_in_map.front(), problem.start_in_map);
  EXPECT_EQ(plan.waypoints_in_map.back(), problem.goal_in_map);
  EXPECT_EQ(why_not_drivable(problem, plan.waypoints_in_map), "");
}

TEST_P(EveryVariant, NamesWhatIsWrongWithTheProblem) {
  const std::vector<std::string> text{".....", ".#...", ".....", ".....", "....."};
  const grid::ClearanceField clearance(grid_from_text(text), 10.0);
  const Point2 free{3.5, 2.5};
  const Point2 wall{1.5, 3.5};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(planner_->plan({clearance, wall, free}, never).outcome, Outcome::kStartBlocked);
  EXPECT_EQ(planner_->plan({clearance, free, wall}, never).outcome, Outcome::kGoalBlocked);
  EXPECT_EQ(planner_->plan({clearance, free, {3.5, 99.0}}, never).outcome, Outcome::kOutOfMap);
  EXPECT_EQ(planner_->plan({clearance, {-1e300, 2.5}, free}, never).outcome, Outcome::kOutOfMap);
  EXPECT_EQ(planner_->plan({clearance, free, {nan, 2.5}}, never).outcome, Outcome::kOutOfMap);
  EXPECT_EQ(planner_->plan({clearance, free, {2.5, 2.5}, 100.0}, never).outcome, Outcome::kStartBlocked);
}

TEST_P(EveryVariant, GivesUpWhenOutOfTime) {
  const grid::ClearanceField clearance(grid::OccupancyGrid(grid::Geometry{200, 200, 1.0, {}}), 10.0);
  EXPECT_EQ(planner_->plan({clearance, {1.5, 1.5}, {198.5, 190.5}}, [] { return true; }).outcome, Outcome::kOutOfTime);
}

TEST_P(EveryVariant, RemembersNothingOfTheQueryBefore) {
  std::mt19937 random(7);
  const grid::OccupancyGrid grid = test_support::random_cells(random, 60, 60, 20);
  const grid::ClearanceField clearance(grid, 20.0);
  const auto any_free = [&] {
    Cell c;
    do c = {test_support::random_between(random, 0, 59), test_support::random_between(random, 0, 59)};
    while (!grid.is_free(c));
    return grid.geometry().center_in_map(c);
  };
  for (int i = 0; i < 200; ++i) {
    if (i % 50 == 49) planner_->rest();
    const Problem problem{clearance, any_free(), any_free()};
    const PlannedPath again = planner_->plan(problem, never);
    const PlannedPath fresh = GetParam().make()->plan(problem, never);
    ASSERT_EQ(again.outcome, fresh.outcome) << "query " << i;
    ASSERT_EQ(again.waypoints_in_map, fresh.waypoints_in_map) << "query " << i;
    ASSERT_EQ(again.expanded, fresh.expanded) << "query " << i;
  }
}

TEST_P(EveryVariant, LeavesATightStartAndEntersATightGoal) {
  // A corridor one metre wide at 0.1 m a cell, open to the right; the vehicle stands 0.3 m from the wall, the margin
  // wants 0.4 m.
  grid::OccupancyGrid grid(grid::Geometry{80, 60, 0.1, {}});
  for (int x = 0; x < 20; ++x) grid.set({x, 20}, grid::Occupancy::kOccupied);
  const grid::ClearanceField clearance(grid, 3.0);
  Problem problem{clearance, {1.05, 2.45}, {6.05, 5.65}, 0.4, 0.3, 1.5};
  EXPECT_EQ(why_not_drivable(problem, planner_->plan(problem, never).waypoints_in_map), "");
  std::swap(problem.start_in_map, problem.goal_in_map);
  EXPECT_EQ(why_not_drivable(problem, planner_->plan(problem, never).waypoints_in_map), "");
  std::swap(problem.start_in_map, problem.goal_in_map);
  problem.least_radius_m = 0.38;
  EXPECT_EQ(planner_->plan(problem, never).outcome, Outcome::kStartBlocked);
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryVariant, testing::ValuesIn(all_variants()), [](const auto& variant) {
  std::string name = variant.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

TEST(Variants, AreFoundByName) {
  ASSERT_NE(find_variant("wang"), nullptr);
  ASSERT_NE(find_variant("astar"), nullptr);
  EXPECT_EQ(find_variant("wnag"), nullptr);
  EXPECT_TRUE(find_variant("astar")->is_optimal);
}

/// Median of how many cells fewer a variant expands than WANG's baseline, as a part of the baseline's.
double median_fewer(const std::string& variant, unsigned maps) {
  const std::unique_ptr<Planner> planner = find_variant(variant)->make();
  const std::unique_ptr<Planner> traditional = traditional_astar(Heuristic::kChebyshev);
  std::vector<double> fewer;
  for (unsigned seed = 1; seed <= maps; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(
        test_support::random_blocks(random, 20, test_support::random_between(random, 8, 19), 4), 20.0);
    const Problem problem{clearance, {0.5, 0.5}, {19.5, 19.5}};
    const PlannedPath ours = planner->plan(problem, never);
    const PlannedPath theirs = traditional->plan(problem, never);
    if (ours.outcome != Outcome::kFound) continue;
    EXPECT_EQ(theirs.outcome, Outcome::kFound) << "seed " << seed;
    fewer.push_back(1.0 - static_cast<double>(ours.expanded) / static_cast<double>(theirs.expanded));
  }
  EXPECT_GT(fewer.size(), maps / 2);
  std::sort(fewer.begin(), fewer.end());
  return fewer.at(fewer.size() / 2);
}

TEST(Wang, ExpandsInTheMedianAsFewCellsOnBlockMapsAsThePaperSays) { EXPECT_GE(median_fewer("wang", 200), 0.579); }

TEST(Li, ExpandsFarFewerCellsOnBlockMaps) { EXPECT_GE(median_fewer("li", 200), 0.6); }

TEST(Qu, ExpandsMoreCellsThanAStarBecauseItsWeightNeverExceedsOne) { EXPECT_LT(median_fewer("qu", 200), 0.0); }

TEST(AStar, NeverGetsShorterByOneMoreObstacle) {
  const std::unique_ptr<Planner> astar = find_variant("astar")->make();
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    grid::OccupancyGrid grid = test_support::random_cells(random, 20, 20, 10);
    grid.set({0, 0}, grid::Occupancy::kFree);
    grid.set({19, 19}, grid::Occupancy::kFree);
    const auto length_m = [&] {
      const grid::ClearanceField clearance(grid, 20.0);
      const PlannedPath plan = astar->plan({clearance, {0.5, 0.5}, {19.5, 19.5}}, never);
      return plan.outcome == Outcome::kFound ? plan.length_m : std::numeric_limits<double>::infinity();
    };
    const double before_m = length_m();
    grid.set({test_support::random_between(random, 1, 18), test_support::random_between(random, 1, 18)},
             grid::Occupancy::kOccupied);
    EXPECT_GE(length_m(), before_m - 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace aisle::global_planner
