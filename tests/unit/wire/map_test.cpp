#include "common/wire/map.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace aisle::wire {
namespace {

grid::Tile tile() {
  grid::Tile tile{"site", 1, 2, 5, 0, {grid::Occupancy::kFree, grid::Occupancy::kOccupied, grid::Occupancy::kUnknown}};
  tile.hash = grid::tile_hash(tile.cells);
  return tile;
}

grid::MapSummary summary() {
  grid::MapSummary summary;
  summary.map_id = "site";
  summary.revision = 5;
  summary.tiling.tile_size = 64;
  summary.tiling.geometry = {100, 70, 0.05, {-1.0, 2.0}};
  summary.tile_hashes = {1, 2, 3, 4};
  summary.hash = grid::map_hash(summary.tile_hashes);
  return summary;
}

TEST(MapCodec, DecodesTheTileItEncodes) {
  const auto decoded = decode(encode(tile()));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_EQ(decoded->map_id, "site");
  EXPECT_EQ(decoded->tile_x, 1);
  EXPECT_EQ(decoded->tile_y, 2);
  EXPECT_EQ(decoded->revision, 5U);
  EXPECT_EQ(decoded->cells, tile().cells);
}

TEST(MapCodec, DecodesTheSummaryItEncodes) {
  const auto decoded = decode(encode(summary()));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_EQ(decoded->tiling.geometry, summary().tiling.geometry);
  EXPECT_EQ(decoded->tile_hashes, summary().tile_hashes);
  EXPECT_EQ(decoded->hash, summary().hash);
}

TEST(MapCodec, RefusesATileThatIsNotWhole) {
  const auto refused = [](const std::function<void(aisle::MapTile&)>& spoil) {
    aisle::MapTile sample = encode(tile());
    spoil(sample);
    return decode(sample).reason();
  };
  EXPECT_NE(refused([](aisle::MapTile& t) { t.map_id(""); }), "");
  EXPECT_NE(refused([](aisle::MapTile& t) { t.cells().clear(); }), "");
  EXPECT_NE(refused([](aisle::MapTile& t) { t.cells()[0] = 3; }), "");
  EXPECT_NE(refused([](aisle::MapTile& t) { t.cells()[0] = 1; }), "");
  EXPECT_NE(refused([](aisle::MapTile& t) { t.tile_x(0xffffffffU); }), "");
  EXPECT_EQ(refused([](aisle::MapTile&) {}), "");
}

TEST(MapCodec, RefusesASummaryThatDoesNotAddUp) {
  const auto refused = [](const std::function<void(aisle::MapInfo&)>& spoil) {
    aisle::MapInfo sample = encode(summary());
    spoil(sample);
    return decode(sample).reason();
  };
  EXPECT_NE(refused([](aisle::MapInfo& m) { m.width_cells(0); }), "");
  EXPECT_NE(refused([](aisle::MapInfo& m) { m.width_cells(0xffffffffU); }), "");
  EXPECT_NE(refused([](aisle::MapInfo& m) { m.resolution_m(std::numeric_limits<double>::quiet_NaN()); }), "");
  EXPECT_NE(refused([](aisle::MapInfo& m) { m.origin_in_map().yaw_rad(0.5); }), "");
  EXPECT_NE(refused([](aisle::MapInfo& m) { m.tile_hashes().pop_back(); }), "");
  EXPECT_NE(refused([](aisle::MapInfo& m) { m.hash(1); }), "");
  EXPECT_EQ(refused([](aisle::MapInfo&) {}), "");
}

TEST(MapCodec, DecodesTheEditItEncodesAndRefusesOthers) {
  const fleet::MapEdit edit{"edit-1",     "site", fleet::MapEdit::Action::kUnblock, fleet::MapEdit::Shape::kDisc,
                            {{1.0, 2.0}}, 0.5};
  const auto decoded = decode(encode(edit));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_EQ(*decoded, edit);
  aisle::MapEdit sample = encode(edit);
  sample.shape(static_cast<aisle::EditShape>(9));
  EXPECT_NE(decode(sample).reason(), "");
  sample = encode(edit);
  sample.points()[0].x_m(std::numeric_limits<double>::infinity());
  EXPECT_NE(decode(sample).reason(), "");
}

}  // namespace
}  // namespace aisle::wire
