#include "common/grid/tiles.hpp"

#include <gtest/gtest.h>

#include "tests/unit/grid/random_grid.hpp"

namespace aisle::grid {
namespace {

TEST(Tiles, CoverEachCellOnce) {
  std::mt19937 random(3);
  OccupancyGrid grid({100, 70, 0.05, {0.0, 0.0}});
  for (int i = 0; i < 500; ++i)
    grid.set({static_cast<int>(random() % 100), static_cast<int>(random() % 70)}, Occupancy::kOccupied);
  const Tiling tiling{32, grid.geometry()};
  ASSERT_EQ(tiling.tiles_x(), 4);
  ASSERT_EQ(tiling.tiles_y(), 3);
  OccupancyGrid copy(grid.geometry(), Occupancy::kUnknown);
  for (int tile = 0; tile < tiling.count(); ++tile) {
    const std::vector<Occupancy> cells = tile_cells(grid, tiling, tile);
    std::size_t i = 0;
    for (int y = tiling.low(tile).y; y < tiling.high(tile).y; ++y) {
      for (int x = tiling.low(tile).x; x < tiling.high(tile).x; ++x) {
        EXPECT_EQ(copy.at({x, y}), Occupancy::kUnknown);
        copy.set({x, y}, cells.at(i++));
      }
    }
    EXPECT_EQ(i, cells.size());
  }
  EXPECT_EQ(copy.cells(), grid.cells());
}

TEST(Tiles, HashAsFnv1aDoes) {
  EXPECT_EQ(tile_hash({}), 0xcbf29ce484222325ULL);
  EXPECT_EQ(tile_hash({Occupancy::kFree}), 0xaf63bd4c8601b7dfULL);
  EXPECT_EQ(map_hash({}), 0xcbf29ce484222325ULL);
  EXPECT_NE(map_hash({1, 2}), map_hash({2, 1}));
  // The bytes 1, 0, 0, 0, 0, 0, 0, 0: little endian.
  EXPECT_EQ(map_hash({1}), tile_hash({Occupancy::kOccupied, Occupancy::kFree, Occupancy::kFree, Occupancy::kFree,
                                      Occupancy::kFree, Occupancy::kFree, Occupancy::kFree, Occupancy::kFree}));
}

}  // namespace
}  // namespace aisle::grid
