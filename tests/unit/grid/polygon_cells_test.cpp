#include "common/grid/polygon_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace aisle::grid {
namespace {

const Geometry kTenByTen{10, 10, 1.0, {}};

bool has(const std::vector<Cell>& cells, int x, int y) {
  return std::any_of(cells.begin(), cells.end(), [&](Cell cell) { return cell.x == x && cell.y == y; });
}

TEST(PolygonCells, ARectangleTouchesTheCellsThatItReachesInto) {
  const auto cells = cells_touching(kTenByTen, {{2.5, 3.5}, {4.5, 3.5}, {4.5, 5.2}, {2.5, 5.2}});
  EXPECT_EQ(cells.size(), 9u);
  EXPECT_TRUE(has(cells, 2, 3));
  EXPECT_TRUE(has(cells, 4, 5));
  EXPECT_FALSE(has(cells, 5, 3));
}

TEST(PolygonCells, ATriangleLeavesOutTheCellsBeyondItsLongSide) {
  const auto cells = cells_touching(kTenByTen, {{0.5, 0.5}, {8.5, 0.5}, {0.5, 8.5}});
  EXPECT_TRUE(has(cells, 4, 4));
  EXPECT_FALSE(has(cells, 5, 5));
  EXPECT_TRUE(has(cells, 2, 2));
}

TEST(PolygonCells, APolygonSmallerThanACellTouchesThatCell) {
  const auto cells = cells_touching(kTenByTen, {{3.2, 3.2}, {3.4, 3.2}, {3.3, 3.4}});
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_TRUE(has(cells, 3, 3));
}

TEST(PolygonCells, OutsideTheGridThereAreNone) {
  EXPECT_TRUE(cells_touching(kTenByTen, {{20.0, 20.0}, {22.0, 20.0}, {21.0, 22.0}}).empty());
  EXPECT_EQ(cells_touching(kTenByTen, {{-5.0, -5.0}, {15.0, -5.0}, {15.0, 15.0}, {-5.0, 15.0}}).size(), 100u);
}

}  // namespace
}  // namespace aisle::grid
