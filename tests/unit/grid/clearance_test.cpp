#include "common/grid/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/grid/random_grid.hpp"

namespace aisle::grid {
namespace {

using testing::random_grid;
using testing::random_point;
using testing::true_clearance_m;

TEST(Clearance, IsTheDistanceToTheNearestSquareAtEveryCentre) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 24);
    const double max_m = grid.geometry().resolution_m * std::uniform_real_distribution<double>(0.6, 30.0)(random);
    const ClearanceField field(grid, max_m);
    for (int y = 0; y < grid.geometry().height; ++y) {
      for (int x = 0; x < grid.geometry().width; ++x) {
        const double expected = std::min(max_m, true_clearance_m(grid, grid.geometry().center_in_map({x, y})));
        ASSERT_NEAR(field.clearance_m(Cell{x, y}), expected, 1e-6 * (1.0 + expected))
            << "seed " << seed << " cell " << x << " " << y;
      }
    }
  }
}

TEST(Clearance, IsExactNearAndFarInLargeGrids) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    OccupancyGrid grid({pick(150, 300), pick(150, 300), 1.0, {0.0, 0.0}});
    const Geometry g = grid.geometry();
    std::vector<Cell> occupied;
    for (int i = pick(0, 6); i > 0; --i) occupied.push_back({pick(0, g.width - 1), pick(0, g.height - 1)});
    for (const Cell cell : occupied) grid.set(cell, Occupancy::kOccupied);
    const double max_m = pick(30, 200);
    const ClearanceField field(grid, max_m);
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x) {
        double nearest = std::min({max_m, x + 0.5, y + 0.5, g.width - x - 0.5, g.height - y - 0.5});
        for (const Cell cell : occupied) {
          nearest = std::min(nearest, std::hypot(std::max(0.0, std::abs(cell.x - x) - 0.5),
                                                 std::max(0.0, std::abs(cell.y - y) - 0.5)));
        }
        ASSERT_NEAR(field.clearance_m(Cell{x, y}), nearest, 1e-6 * (1.0 + nearest))
            << "seed " << seed << " cell " << x << " " << y;
      }
    }
  }
}

TEST(Clearance, IsASafeAndTightLowerBoundAtEveryPoint) {
  double worst_gap_cells = 0.0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 24);
    const double cell_m = grid.geometry().resolution_m;
    const ClearanceField field(grid, 100.0 * cell_m);
    for (int i = 0; i < 400; ++i) {
      const geometry::Point2 p = random_point(random, grid.geometry());
      const double truth = true_clearance_m(grid, p);
      const double bound = field.clearance_m(p);
      ASSERT_LE(bound, truth + 1e-6 * cell_m) << "seed " << seed << " at " << p.x << " " << p.y;
      worst_gap_cells = std::max(worst_gap_cells, (truth - bound) / cell_m);
    }
  }
  EXPECT_LT(worst_gap_cells, 0.75);
}

TEST(Clearance, OfAPointOnACentreIsThatOfTheCell) {
  std::mt19937 random(5);
  const OccupancyGrid grid = random_grid(random);
  const ClearanceField field(grid);
  for (int y = 0; y < grid.geometry().height; ++y) {
    for (int x = 0; x < grid.geometry().width; ++x) {
      EXPECT_DOUBLE_EQ(field.clearance_m(grid.geometry().center_in_map({x, y})), field.clearance_m(Cell{x, y}))
          << x << " " << y;
    }
  }
}

TEST(Clearance, IsZeroOutsideAndForNonsense) {
  const ClearanceField field(OccupancyGrid({10, 10, 0.1, {0.0, 0.0}}));
  EXPECT_EQ(field.clearance_m(geometry::Point2{-0.01, 0.5}), 0.0);
  EXPECT_EQ(field.clearance_m(geometry::Point2{0.5, 1.01}), 0.0);
  EXPECT_EQ(field.clearance_m(geometry::Point2{1e308, 0.5}), 0.0);
  EXPECT_EQ(field.clearance_m(geometry::Point2{std::nan(""), 0.5}), 0.0);
  EXPECT_EQ(field.clearance_m(Cell{10, 0}), 0.0);
  EXPECT_EQ(ClearanceField().clearance_m(geometry::Point2{0.0, 0.0}), 0.0);
}

TEST(Clearance, LetsNobodyStandOnAnObstacleWhateverItsRadius) {
  OccupancyGrid grid({3, 3, 1.0, {0.0, 0.0}});
  grid.set({1, 1}, Occupancy::kUnknown);
  const ClearanceField field(grid);
  EXPECT_FALSE(field.is_traversable({1, 1}, 0.0));
  EXPECT_TRUE(field.is_traversable({0, 1}, 0.0));
  EXPECT_TRUE(field.is_traversable({0, 1}, 0.5));
  EXPECT_FALSE(field.is_traversable({0, 1}, 0.51));
  EXPECT_FALSE(field.is_traversable({-1, 0}, 0.0));
}

TEST(Clearance, UpdatedAfterAnEditEqualsAFieldMadeAnew) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    OccupancyGrid grid = random_grid(random, seed % 40 == 0 ? 260 : 60);
    const Geometry g = grid.geometry();
    const double max_m =
        g.resolution_m * std::uniform_real_distribution<double>(0.6, seed % 40 == 0 ? 90.0 : 20.0)(random);
    ClearanceField field(grid, max_m);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const Cell low{pick(0, g.width - 1), pick(0, g.height - 1)};
    const Cell high{pick(low.x, std::min(g.width - 1, low.x + 8)), pick(low.y, std::min(g.height - 1, low.y + 8))};
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) grid.set({x, y}, pick(0, 1) == 0 ? Occupancy::kFree : Occupancy::kOccupied);
    }
    field.update(grid, low, high);
    const ClearanceField anew(grid, max_m);
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x)
        ASSERT_EQ(field.clearance_m(Cell{x, y}), anew.clearance_m(Cell{x, y})) << "seed " << seed;
    }
  }
}

TEST(Clearance, CountsCellsAsOccupiedForAnUpdateWithoutTouchingTheGrid) {
  std::mt19937 random(3);
  OccupancyGrid grid = random_grid(random, 60);
  ClearanceField field(grid, 2.0);
  const ClearanceField before = field;
  const std::vector<Cell> also{{3, 4}, {4, 4}};
  field.update(grid, {3, 4}, {4, 4}, also);
  OccupancyGrid with_them = grid;
  for (const Cell cell : also) with_them.set(cell, Occupancy::kOccupied);
  EXPECT_EQ(field.cells_m(), ClearanceField(with_them, 2.0).cells_m());
  EXPECT_NE(field.cells_m(), before.cells_m());
  field.update(grid, {3, 4}, {4, 4});
  EXPECT_EQ(field.cells_m(), before.cells_m());
}

}  // namespace
}  // namespace aisle::grid
