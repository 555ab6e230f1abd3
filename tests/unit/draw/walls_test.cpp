#include "tools/draw/walls.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/ascii_grid.hpp"

namespace aisle::draw {
namespace {

using grid::Occupancy;
using test_support::grid_from_text;

bool holds(const std::vector<Box>& boxes, geometry::Point2 p) {
  int times = 0;
  for (const Box& box : boxes)
    times += p.x > box.low_in_map.x && p.x < box.high_in_map.x && p.y > box.low_in_map.y && p.y < box.high_in_map.y;
  EXPECT_LE(times, 1) << "boxes overlap at " << p.x << ", " << p.y;
  return times > 0;
}

grid::OccupancyGrid random_grid(unsigned seed) {
  std::mt19937 random(seed);
  grid::OccupancyGrid grid(grid::Geometry{23, 17, 1.0, {-4.0, 2.0}});
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 23; ++x) grid.set({x, y}, static_cast<Occupancy>(random() % 3));
  return grid;
}

TEST(Walls, EveryCellIsInTheLayerOfItsOccupancy) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const grid::OccupancyGrid grid = random_grid(seed);
    const GridLayers layers = grid_layers(grid);
    const std::vector<Box> blocked = obstacles(grid);
    for (int y = 0; y < 17; ++y)
      for (int x = 0; x < 23; ++x) {
        const geometry::Point2 p = grid.geometry().center_in_map({x, y});
        EXPECT_EQ(holds(layers.occupied, p), grid.at({x, y}) == Occupancy::kOccupied);
        EXPECT_EQ(holds(layers.unknown, p), grid.at({x, y}) == Occupancy::kUnknown);
        EXPECT_EQ(holds(blocked, p), !grid.is_free({x, y}));
      }
  }
}

TEST(Walls, ABlockShowsItsWorstCellAndEndsWithTheGrid) {
  const GridLayers layers = grid_layers(grid_from_text({"..?", "...", "#.."}), 2);
  ASSERT_EQ(layers.occupied.size(), 1U);
  EXPECT_EQ(layers.occupied[0].high_in_map, (geometry::Point2{2.0, 2.0}));
  ASSERT_EQ(layers.unknown.size(), 1U);
  EXPECT_EQ(layers.unknown[0].low_in_map, (geometry::Point2{2.0, 2.0}));
  EXPECT_EQ(layers.unknown[0].high_in_map, (geometry::Point2{3.0, 3.0}));
}

TEST(Walls, EqualRunsBelowEachOtherAreOneBox) {
  EXPECT_EQ(obstacles(grid_from_text({"##.", "##.", "##."})).size(), 1U);
  EXPECT_EQ(obstacles(grid_from_text({"###", "#..", "#.."})).size(), 2U);
}

TEST(Walls, AreWrittenToATenthOrToFiveDigits) {
  const std::vector<Box> boxes{{{1.0, 2.0}, {3.0, 2.5}}};
  const MapFrame frame{{0.0, 0.0}, {10.0, 10.0}, 0.0, 0.0, 3.125};
  EXPECT_EQ(boxes_path(frame, boxes, Digits::kTenth), "M3.1 23.4h6.2v1.6h-6.2z");
  EXPECT_EQ(boxes_path(frame, boxes, Digits::kFine), "M3.125 23.438h6.25v1.5625h-6.25z");
}

}  // namespace
}  // namespace aisle::draw
