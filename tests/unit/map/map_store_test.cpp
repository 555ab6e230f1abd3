#include "services/map/core/map_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/config/reader.hpp"
#include "tests/unit/map/temporary_folder.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;
using fleet::MapEditResult;
using grid::Occupancy;
using Outcome = MapEditResult::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

grid::OccupancyGrid empty_floor() { return grid::OccupancyGrid(grid::Geometry{150, 100, 0.1, {-1.0, -2.0}}); }

MapEdit block(const std::string& id, geometry::Point2 low, geometry::Point2 high) {
  return {id, "site", MapEdit::Action::kBlock, MapEdit::Shape::kRectangle, {low, high}, 0.0};
}
MapEdit unblock(const std::string& id, geometry::Point2 low, geometry::Point2 high) {
  return {id, "site", MapEdit::Action::kUnblock, MapEdit::Shape::kRectangle, {low, high}, 0.0};
}

MapStore store(std::unique_ptr<Journal> journal = nullptr, const MapStore::Limits& limits = {}) {
  return {SiteMap("site", empty_floor()), std::move(journal), limits};
}

/// What mirrors rely on, whatever was edited.
void expect_consistent(const SiteMap& map) {
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < map.tiles(); ++i) {
    const grid::Tile tile = map.tile(i);
    EXPECT_EQ(tile.hash, grid::tile_hash(tile.cells));
    EXPECT_EQ(tile.cells, grid::tile_cells(map.grid(), map.summary().tiling, i));
    EXPECT_LE(tile.revision, map.revision());
    hashes.push_back(tile.hash);
  }
  EXPECT_EQ(map.summary().tile_hashes, hashes);
  EXPECT_EQ(map.summary().hash, grid::map_hash(hashes));
}

TEST(MapStore, AppliesAnEditAndListsTheTilesThatChanged) {
  MapStore site = store();
  EXPECT_EQ(site.map().revision(), 1U);
  // Cells x 60..67, y 10..14: two tiles.
  const MapStore::Answer answer = site.take(block("e1", {5.0, -1.0}, {5.8, -0.5}), "test", 1);
  EXPECT_EQ(answer.result.outcome, Outcome::kApplied);
  EXPECT_EQ(answer.result.edit_id, "e1");
  EXPECT_EQ(answer.result.revision, 2U);
  EXPECT_EQ(answer.result.changed_cells, 40U);
  EXPECT_THAT(answer.changed_tiles, ElementsAre(0, 1));
  EXPECT_EQ(site.map().grid().at({60, 10}), Occupancy::kOccupied);
  EXPECT_EQ(site.map().grid().at({67, 14}), Occupancy::kOccupied);
  EXPECT_EQ(site.map().grid().at({68, 14}), Occupancy::kFree);
  EXPECT_EQ(site.map().tile(0).revision, 2U);
  EXPECT_EQ(site.map().tile(2).revision, 1U);
  expect_consistent(site.map());
}

TEST(MapStore, BlockAndUnblockOfTheSameShapeRestoresTheFloor) {
  MapStore site = store();
  const std::uint64_t hash = site.map().summary().hash;
  MapEdit disc{"d1", "site", MapEdit::Action::kBlock, MapEdit::Shape::kDisc, {{3.33, 1.27}}, 0.777};
  EXPECT_GT(site.take(disc, "test", 1).result.changed_cells, 100U);
  EXPECT_NE(site.map().summary().hash, hash);
  disc.edit_id = "d2";
  disc.action = MapEdit::Action::kUnblock;
  site.take(disc, "test", 1);
  EXPECT_EQ(site.map().summary().hash, hash);
  EXPECT_EQ(site.map().revision(), 3U);
}

TEST(MapStore, AppliesAnEditIdOnce) {
  MapStore site = store();
  site.take(block("e1", {0.0, 0.0}, {1.0, 1.0}), "test", 1);
  site.take(unblock("e2", {0.0, 0.0}, {1.0, 1.0}), "test", 1);
  const MapStore::Answer again = site.take(block("e1", {0.0, 0.0}, {1.0, 1.0}), "test", 1);
  EXPECT_EQ(again.result.outcome, Outcome::kAlreadyApplied);
  EXPECT_EQ(again.result.revision, 2U);
  EXPECT_EQ(again.result.changed_cells, 100U);
  EXPECT_TRUE(again.changed_tiles.empty());
  EXPECT_EQ(site.map().revision(), 3U);
  EXPECT_EQ(site.map().grid().at({10, 20}), Occupancy::kFree);
  const MapStore::Answer other = site.take(block("e1", {0.0, 0.0}, {2.0, 1.0}), "test", 1);
  EXPECT_EQ(other.result.outcome, Outcome::kRefused);
  EXPECT_THAT(other.result.detail, HasSubstr("edit_id"));
}

TEST(MapStore, CountsAnEditThatChangesNothing) {
  MapStore site = store();
  const MapStore::Answer answer = site.take(unblock("e1", {0.0, 0.0}, {1.0, 1.0}), "test", 1);
  EXPECT_EQ(answer.result.outcome, Outcome::kApplied);
  EXPECT_EQ(answer.result.changed_cells, 0U);
  EXPECT_TRUE(answer.changed_tiles.empty());
  EXPECT_EQ(site.map().revision(), 2U);
}

TEST(MapStore, RefusesWithAReasonAndChangesNothing) {
  MapStore::Limits limits;
  limits.edit.max_cells = 5000;
  MapStore site = store(nullptr, limits);
  const std::uint64_t hash = site.map().summary().hash;
  const auto refusal = [&](const MapEdit& edit) {
    const MapStore::Answer answer = site.take(edit, "test", 1);
    EXPECT_EQ(answer.result.outcome, Outcome::kRefused) << edit.edit_id;
    EXPECT_EQ(answer.result.edit_id, edit.edit_id);
    EXPECT_TRUE(answer.changed_tiles.empty());
    return answer.result.detail;
  };
  MapEdit e = block("foreign", {0.0, 0.0}, {1.0, 1.0});
  e.map_id = "annex";
  EXPECT_THAT(refusal(e), HasSubstr("'annex'"));
  EXPECT_THAT(refusal(block("nan", {0.0, std::nan("")}, {1.0, 1.0})), HasSubstr("finite"));
  EXPECT_THAT(refusal(block("inf", {0.0, 0.0}, {INFINITY, 1.0})), HasSubstr("finite"));
  EXPECT_THAT(refusal(block("outside", {100.0, 100.0}, {101.0, 101.0})), HasSubstr("outside the map"));
  EXPECT_THAT(refusal(block("flat", {1.0, 1.0}, {1.0, 2.0})), HasSubstr("no area"));
  EXPECT_THAT(refusal(block("huge", {-1e300, -1e300}, {1e300, 1e300})), HasSubstr("15000 cells"));
  EXPECT_THAT(refusal(block("", {0.0, 0.0}, {1.0, 1.0})), HasSubstr("edit_id"));
  e = block("polygon", {0.0, 0.0}, {1.0, 1.0});
  e.shape = MapEdit::Shape::kPolygon;
  EXPECT_THAT(refusal(e), HasSubstr("3 to 64"));
  e.points_in_map = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  EXPECT_THAT(refusal(e), HasSubstr("no area"));
  e.shape = MapEdit::Shape::kRectangle;
  EXPECT_THAT(refusal(e), HasSubstr("2 corners"));
  e.shape = MapEdit::Shape::kDisc;
  EXPECT_THAT(refusal(e), HasSubstr("1 centre"));
  e.points_in_map = {{0.0, 0.0}};
  EXPECT_THAT(refusal(e), HasSubstr("radius_m"));
  e.radius_m = -1.0;
  EXPECT_THAT(refusal(e), HasSubstr("-1"));
  e.radius_m = std::nan("");
  EXPECT_THAT(refusal(e), HasSubstr("radius_m"));
  e.shape = static_cast<MapEdit::Shape>(9);
  EXPECT_THAT(refusal(e), HasSubstr("shape"));
  EXPECT_EQ(site.map().revision(), 1U);
  EXPECT_EQ(site.map().summary().hash, hash);
  EXPECT_EQ(site.edits(), 0U);
}

TEST(MapStore, BoundsTheNumberOfEdits) {
  MapStore::Limits limits;
  limits.max_edits = 2;
  MapStore site = store(nullptr, limits);
  site.take(block("e1", {0.0, 0.0}, {1.0, 1.0}), "test", 1);
  site.take(block("e2", {0.0, 0.0}, {1.0, 1.0}), "test", 1);
  EXPECT_THAT(site.take(block("e3", {0.0, 0.0}, {1.0, 1.0}), "test", 1).result.detail, HasSubstr("2 edits"));
  EXPECT_EQ(site.take(block("e2", {0.0, 0.0}, {1.0, 1.0}), "test", 1).result.outcome, Outcome::kAlreadyApplied);
}

std::unique_ptr<Journal> journal_of(const testing::TemporaryFolder& folder, const Journal::Options& options = {}) {
  return std::make_unique<Journal>(folder.path() / "site.journal", "site",
                                   SiteMap("site", empty_floor()).summary().hash, options);
}

TEST(MapStore, IsTheSameAfterARestartWithItsJournal) {
  const testing::TemporaryFolder folder;
  std::mt19937 random(11);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::uint64_t revision = 1;
  std::uint64_t hash = 0;
  for (int start = 0; start < 6; ++start) {
    MapStore site = store(journal_of(folder));
    EXPECT_EQ(site.map().revision(), revision);
    EXPECT_TRUE(start == 0 || site.map().summary().hash == hash);
    expect_consistent(site.map());
    for (int i = 0; i < 30; ++i) {
      MapEdit edit{"e" + std::to_string(start) + "-" + std::to_string(i),
                   "site",
                   MapEdit::Action::kBlock,
                   MapEdit::Shape::kPolygon,
                   {},
                   0.0};
      if (i % 3 == 0) edit.action = MapEdit::Action::kUnblock;
      for (int corner = 0; corner < 5; ++corner) edit.points_in_map.push_back({number(-2.0, 15.0), number(-3.0, 9.0)});
      const bool applied = site.take(edit, "test", i).result.outcome == Outcome::kApplied;
      revision += applied ? 1 : 0;
    }
    EXPECT_GT(revision, 1U);
    hash = site.map().summary().hash;
  }
  MapStore site = store(journal_of(folder));
  EXPECT_EQ(site.take(block("late", {0.0, 0.0}, {1.0, 1.0}), "test", 1).result.revision, revision + 1);
}

TEST(MapStore, RefusesWhatItsJournalCannotKeepAndGoesOn) {
  const testing::TemporaryFolder folder;
  Journal::Options options;
  options.max_bytes = 80000;
  MapStore site = store(journal_of(folder, options));
  MapEditResult result;
  int edits = 0;
  do {
    ++edits;
    result = site.take(block("e" + std::to_string(edits), {0.0, 0.0}, {1.0, 0.1 * (1 + edits % 40)}), "test", 1).result;
  } while (result.outcome == Outcome::kApplied && edits < 5000);
  ASSERT_EQ(result.outcome, Outcome::kRefused);
  EXPECT_THAT(result.detail, HasSubstr("journal"));
  EXPECT_EQ(site.map().revision(), static_cast<std::uint64_t>(edits));
  const std::uint64_t hash = site.map().summary().hash;
  EXPECT_EQ(site.take(block("e1", {0.0, 0.0}, {1.0, 0.1 * 2}), "test", 1).result.outcome, Outcome::kAlreadyApplied);
  EXPECT_EQ(site.map().summary().hash, hash) << "what was refused was not applied";
}

TEST(MapStore, RefusesAJournalWhoseEditsDoNotFitTheMap) {
  const testing::TemporaryFolder folder;
  {
    MapStore site = store(journal_of(folder));
    site.take(block("far", {10.0, 5.0}, {11.0, 6.0}), "test", 1);
  }
  EXPECT_THROW(MapStore(SiteMap("site", grid::OccupancyGrid({10, 10, 0.1, {0.0, 0.0}})), journal_of(folder), {}),
               config::BadInput);
}

}  // namespace
}  // namespace aisle::map
