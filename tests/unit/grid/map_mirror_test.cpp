#include "common/grid/map_mirror.hpp"

#include <gtest/gtest.h>

#include "common/grid/clearance.hpp"
#include "tests/unit/grid/random_grid.hpp"

namespace aisle::grid {
namespace {

using Change = MapMirror::Change;

/// A small map with its summary and tiles at any revision.
struct Site {
  OccupancyGrid grid{Geometry{50, 33, 0.1, {1.0, -2.0}}};
  Tiling tiling{16, grid.geometry()};
  std::uint64_t revision{1};
  std::vector<std::uint64_t> tile_revisions = std::vector<std::uint64_t>(static_cast<std::size_t>(tiling.count()), 1);

  Tile tile(int index) const {
    std::vector<Occupancy> cells = tile_cells(grid, tiling, index);
    return {"site",
            index % tiling.tiles_x(),
            index / tiling.tiles_x(),
            tile_revisions[static_cast<std::size_t>(index)],
            tile_hash(cells),
            cells};
  }
  MapSummary summary() const {
    MapSummary s{"site", revision, 0, tiling, {}};
    for (int i = 0; i < tiling.count(); ++i) s.tile_hashes.push_back(tile(i).hash);
    s.hash = map_hash(s.tile_hashes);
    return s;
  }
  /// Changes one cell; returns the tile that changed.
  int edit(Cell c, Occupancy o) {
    grid.set(c, o);
    ++revision;
    const int index = c.y / tiling.tile_size * tiling.tiles_x() + c.x / tiling.tile_size;
    tile_revisions[static_cast<std::size_t>(index)] = revision;
    return index;
  }
  void fill(MapMirror& mirror) const {
    mirror.take(summary());
    for (int i = 0; i < tiling.count(); ++i) mirror.take(tile(i));
  }
};

TEST(MapMirror, IsCompleteWithTheLastTile) {
  Site site;
  site.grid.set({49, 32}, Occupancy::kOccupied);
  MapMirror mirror;
  EXPECT_FALSE(mirror.is_complete());
  EXPECT_EQ(mirror.take(site.summary()), Change::kProgress);
  EXPECT_EQ(mirror.missing_tiles().size(), 12U);
  for (int i = 0; i < 11; ++i) EXPECT_EQ(mirror.take(site.tile(i)), Change::kProgress);
  EXPECT_FALSE(mirror.is_complete());
  EXPECT_EQ(mirror.revision(), 0U);
  EXPECT_EQ(mirror.missing_tiles(), std::vector<std::uint32_t>{11});
  EXPECT_EQ(mirror.take(site.tile(11)), Change::kComplete);
  EXPECT_TRUE(mirror.is_complete());
  EXPECT_EQ(mirror.revision(), 1U);
  EXPECT_EQ(mirror.grid().cells(), site.grid.cells());
  EXPECT_EQ(mirror.changed_low(), (Cell{0, 0}));
  EXPECT_EQ(mirror.changed_high(), (Cell{49, 32}));
}

TEST(MapMirror, TakesTilesBeforeTheirSummary) {
  Site site;
  MapMirror mirror;
  for (int i = 0; i < site.tiling.count(); ++i) EXPECT_EQ(mirror.take(site.tile(i)), Change::kProgress);
  EXPECT_EQ(mirror.take(site.summary()), Change::kComplete);

  const int index = site.edit({20, 20}, Occupancy::kOccupied);
  EXPECT_EQ(mirror.take(site.tile(index)), Change::kProgress);
  EXPECT_TRUE(mirror.is_complete()) << "a tile of the future does not spoil the present";
  EXPECT_TRUE(mirror.grid().is_free({20, 20}));
  EXPECT_EQ(mirror.take(site.summary()), Change::kComplete);
  EXPECT_FALSE(mirror.grid().is_free({20, 20}));
  EXPECT_EQ(mirror.changed_low(), (Cell{20, 20}));
  EXPECT_EQ(mirror.changed_high(), (Cell{20, 20}));
}

TEST(MapMirror, KeepsTheCompleteMapWhileNewerTilesComeIn) {
  Site site;
  MapMirror mirror;
  site.fill(mirror);
  const int index = site.edit({3, 3}, Occupancy::kOccupied);
  EXPECT_EQ(mirror.take(site.summary()), Change::kProgress);
  EXPECT_FALSE(mirror.is_complete());
  EXPECT_EQ(mirror.revision(), 1U);
  EXPECT_TRUE(mirror.grid().is_free({3, 3}));
  EXPECT_EQ(mirror.missing_tiles(), std::vector<std::uint32_t>{static_cast<std::uint32_t>(index)});
  EXPECT_EQ(mirror.take(site.tile(index)), Change::kComplete);
  EXPECT_EQ(mirror.revision(), 2U);
}

TEST(MapMirror, IgnoresWhatIsOldDuplicateCorruptOrForeign) {
  Site site;
  MapMirror mirror;
  site.fill(mirror);
  const Tile old_tile = site.tile(0);
  const MapSummary old_summary = site.summary();
  mirror.take(site.tile(site.edit({3, 3}, Occupancy::kOccupied)));
  ASSERT_EQ(mirror.take(site.summary()), Change::kComplete);

  EXPECT_EQ(mirror.take(old_summary), Change::kNone);
  EXPECT_EQ(mirror.take(old_tile), Change::kNone);
  EXPECT_EQ(mirror.take(site.summary()), Change::kNone);
  EXPECT_EQ(mirror.take(site.tile(0)), Change::kNone);
  site.edit({4, 4}, Occupancy::kOccupied);
  mirror.take(site.summary());
  Tile corrupt = site.tile(0);
  corrupt.cells[100] = Occupancy::kUnknown;
  EXPECT_EQ(mirror.take(corrupt), Change::kNone);
  Tile unknown_value = site.tile(0);
  unknown_value.cells[5] = static_cast<Occupancy>(7);
  unknown_value.hash = tile_hash(unknown_value.cells);
  EXPECT_EQ(mirror.take(unknown_value), Change::kNone);
  Tile foreign = site.tile(0);
  foreign.map_id = "elsewhere";
  EXPECT_EQ(mirror.take(foreign), Change::kNone);
  Tile outside = site.tile(0);
  outside.tile_x = 4;
  EXPECT_EQ(mirror.take(outside), Change::kNone);
  Tile small = site.tile(0);
  small.cells.pop_back();
  small.hash = tile_hash(small.cells);
  EXPECT_EQ(mirror.take(small), Change::kNone);
  EXPECT_FALSE(mirror.is_complete());
  EXPECT_EQ(mirror.take(site.tile(0)), Change::kComplete);
}

TEST(MapMirror, RefusesSummariesThatContradictThemselves) {
  const Site site;
  const auto refuses = [&](void (*spoil)(MapSummary&)) {
    MapSummary summary = site.summary();
    spoil(summary);
    MapMirror mirror;
    return mirror.take(summary) == Change::kNone && !mirror.summary();
  };
  EXPECT_FALSE(refuses([](MapSummary&) {}));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.hash ^= 1; }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.tile_hashes.pop_back(); }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.tiling.geometry.width = 2147483647; }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.tiling.geometry.height = -1; }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.tiling.tile_size = 0; }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.tiling.geometry.resolution_m = std::nan(""); }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.tiling.geometry.origin_in_map.x = INFINITY; }));
  EXPECT_TRUE(refuses([](MapSummary& s) { s.revision = 0; }));
}

TEST(MapMirror, StartsOverForAnotherMap) {
  Site site;
  MapMirror mirror;
  site.fill(mirror);
  Site other;
  MapSummary summary = other.summary();
  summary.map_id = "annex";
  EXPECT_EQ(mirror.take(summary), Change::kProgress);
  EXPECT_EQ(mirror.revision(), 0U);
  EXPECT_EQ(mirror.missing_tiles().size(), 12U);
}

TEST(MapMirror, ReportsAnEditThatChangesNothing) {
  Site site;
  MapMirror mirror;
  site.fill(mirror);
  site.edit({3, 3}, Occupancy::kFree);
  EXPECT_EQ(mirror.take(site.summary()), Change::kComplete);
  EXPECT_EQ(mirror.revision(), 2U);
  EXPECT_LT(mirror.changed_high().x, mirror.changed_low().x);
}

TEST(MapMirror, EndsEqualHoweverTheSamplesAreMixed) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    Site site;
    MapMirror mirror;
    ClearanceField field;
    const auto note = [&](Change change) {
      if (change != Change::kComplete) return;
      if (field.geometry() != mirror.grid().geometry()) field = ClearanceField(mirror.grid());
      field.update(mirror.grid(), mirror.changed_low(), mirror.changed_high());
    };
    std::vector<MapSummary> summaries{site.summary()};
    std::vector<Tile> tiles;
    for (int i = 0; i < site.tiling.count(); ++i) tiles.push_back(site.tile(i));
    for (int i = 0; i < 10; ++i) {
      const int index =
          site.edit({pick(0, 49), pick(0, 32)}, pick(0, 1) == 0 ? Occupancy::kOccupied : Occupancy::kFree);
      tiles.push_back(site.tile(index));
      summaries.push_back(site.summary());
    }
    for (int i = 0; i < 60; ++i) {  // any order, lost, twice
      if (pick(0, 2) == 0) {
        note(mirror.take(summaries[static_cast<std::size_t>(pick(0, static_cast<int>(summaries.size()) - 1))]));
      } else {
        note(mirror.take(tiles[static_cast<std::size_t>(pick(0, static_cast<int>(tiles.size()) - 1))]));
      }
    }
    note(mirror.take(site.summary()));
    for (const std::uint32_t index : mirror.missing_tiles()) note(mirror.take(site.tile(static_cast<int>(index))));
    ASSERT_TRUE(mirror.is_complete()) << "seed " << seed;
    ASSERT_EQ(mirror.revision(), 11U);
    ASSERT_EQ(mirror.grid().cells(), site.grid.cells()) << "seed " << seed;
    const ClearanceField anew(site.grid);
    for (int y = 0; y < 33; ++y) {
      for (int x = 0; x < 50; ++x)
        ASSERT_EQ(field.clearance_m(Cell{x, y}), anew.clearance_m(Cell{x, y})) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace aisle::grid
