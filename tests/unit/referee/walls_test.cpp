#include "tools/referee/core/walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace aisle::referee {
namespace {

using geometry::Pose2;

grid::OccupancyGrid empty_map(int width, int height) { return grid::OccupancyGrid({width, height, 0.1, {-1.0, -2.0}}); }

Motion disc(const Pose2& begin, const Pose2& end) { return {{0.3, 0.0, 0.0}, begin, end}; }

TEST(Walls, AreExactlyTheOccupiedSquares) {
  grid::OccupancyGrid map = empty_map(40, 30);
  std::mt19937 random(7);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x)
      map.set({x, y}, random() % 3 == 0 ? grid::Occupancy::kOccupied : grid::Occupancy::kFree);
  }
  const Walls walls(map);
  std::vector<int> covered(map.geometry().cells(), 0);
  for (const WallBox& box : walls.boxes()) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        const geometry::Point2 c = map.geometry().center_in_map({x, y});
        if (c.x > box.low.x && c.x < box.high.x && c.y > box.low.y && c.y < box.high.y)
          ++covered[map.geometry().index({x, y})];
      }
    }
  }
  for (std::size_t i = 0; i < covered.size(); ++i)
    EXPECT_EQ(covered[i], map.cells()[i] == grid::Occupancy::kOccupied ? 1 : 0);
}

TEST(Walls, MeasureToTheCornerOfASquare) {
  grid::OccupancyGrid map = empty_map(60, 60);
  map.set({20, 20}, grid::Occupancy::kOccupied);  // x 1.0..1.1, y 0.0..0.1
  const Walls walls(map);
  const auto approach = walls.closest(disc({1.4, 0.5, 0}, {1.4, 0.5, 0}));
  ASSERT_TRUE(approach);
  EXPECT_NEAR(approach->clearance_m, std::hypot(0.3, 0.4) - 0.3, 1e-9);
}

TEST(Walls, StopATunnellingVehicle) {
  grid::OccupancyGrid map = empty_map(60, 60);
  for (int y = 0; y < 60; ++y) map.set({30, y}, grid::Occupancy::kOccupied);
  const auto approach = Walls(map).closest(disc({0.0, 0.0, 0}, {4.5, 0.3, 0}));
  ASSERT_TRUE(approach);
  EXPECT_LE(approach->clearance_m, 0.0);
}

TEST(Walls, AreNotSeenFromAfarAndUnknownIsNoWall) {
  grid::OccupancyGrid map = empty_map(60, 60);
  map.set({0, 0}, grid::Occupancy::kOccupied);
  map.set({40, 40}, grid::Occupancy::kUnknown);
  const Walls walls(map);
  EXPECT_FALSE(walls.closest(disc({3.0, 2.0, 0}, {3.0, 2.0, 0})));
  EXPECT_TRUE(walls.closest(disc({-0.5, -1.5, 0}, {-0.5, -1.5, 0})));
}

TEST(Walls, AgreeWithEverySquareTriedAlone) {
  grid::OccupancyGrid map = empty_map(80, 80);
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i)
    map.set({static_cast<int>(random() % 80), static_cast<int>(random() % 80)}, grid::Occupancy::kOccupied);
  const Walls walls(map);
  std::uniform_real_distribution<double> x(-1.5, 7.5), y(-2.5, 6.5), step(-1.5, 1.5);
  for (int i = 0; i < 200; ++i) {
    const Pose2 begin{x(random), y(random), 0.0};
    const Motion body = disc(begin, {begin.x + step(random), begin.y + step(random), 0.0});
    double least = 1e18;
    for (int cy = 0; cy < 80; ++cy) {
      for (int cx = 0; cx < 80; ++cx) {
        if (map.at({cx, cy}) != grid::Occupancy::kOccupied) continue;
        const geometry::Point2 c = map.geometry().center_in_map({cx, cy});
        const Motion square{{0.0, 0.1, 0.1}, {c.x, c.y, 0}, {c.x, c.y, 0}};
        least = std::min(least, closest_approach(body, square).clearance_m);
      }
    }
    const auto said = walls.closest(body);
    if (least > Walls::kSearch_m) {
      EXPECT_FALSE(said) << i;
    } else {
      ASSERT_TRUE(said) << i;
      EXPECT_EQ(said->clearance_m <= 0.0, least <= 0.0) << i;
      if (least > 0.0) {
        EXPECT_NEAR(said->clearance_m, least, 1e-9) << i;
      }
    }
  }
}

}  // namespace
}  // namespace aisle::referee
