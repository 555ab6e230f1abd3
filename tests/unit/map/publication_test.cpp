#include "services/map/core/publication.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle::map {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Action = fleet::MapEdit::Action;
using Outcome = fleet::MapEditResult::Outcome;

/// 3 x 2 tiles.
Publication publication() {
  return Publication(
      MapStore(SiteMap("site", grid::OccupancyGrid(grid::Geometry{150, 100, 0.1, {0.0, 0.0}})), nullptr, {}));
}

fleet::MapEdit block(const std::string& id, geometry::Point2 low, geometry::Point2 high) {
  return {id, "site", Action::kBlock, fleet::MapEdit::Shape::kRectangle, {low, high}, 0.0};
}

TEST(Publication, BeginsWithTheWholeMap) {
  const Batch batch = publication().whole();
  EXPECT_THAT(batch.tiles, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_TRUE(batch.has_summary);
  EXPECT_THAT(batch.results, IsEmpty());
}

TEST(Publication, OfSeveralEditsIsEachTileOnceAndOneSummary) {
  Publication site = publication();
  EXPECT_EQ(site.take(block("a", {1.0, 1.0}, {2.0, 2.0}), "test", 1).outcome, Outcome::kApplied);
  EXPECT_EQ(site.take(block("b", {1.0, 2.0}, {2.0, 3.0}), "test", 2).revision, 3U);
  Batch batch = site.changes();
  EXPECT_THAT(batch.tiles, ElementsAre(0));
  EXPECT_TRUE(batch.has_summary);
  ASSERT_EQ(batch.results.size(), 2U);
  EXPECT_EQ(batch.results[1].edit_id, "b");

  batch = site.changes();
  EXPECT_THAT(batch.tiles, IsEmpty());
  EXPECT_FALSE(batch.has_summary);
  EXPECT_THAT(batch.results, IsEmpty());
}

TEST(Publication, OfARefusalIsItsResultAlone) {
  Publication site = publication();
  EXPECT_EQ(site.refuse("strange", "shape = 77 is no known value").outcome, Outcome::kRefused);
  const Batch batch = site.changes();
  EXPECT_FALSE(batch.has_summary);
  ASSERT_EQ(batch.results.size(), 1U);
  EXPECT_EQ(batch.results[0].detail, "shape = 77 is no known value");
  EXPECT_EQ(batch.results[0].map_id, "site");
  EXPECT_EQ(batch.results[0].revision, 1U);
}

TEST(Publication, AnEditIsNamedInTheLogWhateverItsOutcome) {
  Publication site = publication();
  const fleet::MapEdit wall = block("wall", {1.0, 1.0}, {2.0, 2.0});
  EXPECT_EQ(log_text(site.take(wall, "test", 1)), "edit=wall applied revision=2 changed_cells=100");
  EXPECT_EQ(log_text(site.take(wall, "test", 2)), "edit=wall was applied before revision=2 changed_cells=100");
  EXPECT_EQ(log_text(site.refuse("odd", "shape = 77 is no known value")),
            "edit=odd refused reason=\"shape = 77 is no known value\"");
}

TEST(Publication, OfWhatWasAskedForComesInPartsAndTheSummaryLast) {
  Publication site = publication();
  EXPECT_THAT(site.ask({"mirror", "site", 1, {5, 0, 5, 3, 99}}), ElementsAre("tiles beyond the map"));
  Batch batch = site.requested(2);
  EXPECT_THAT(batch.tiles, ElementsAre(0, 3));
  EXPECT_FALSE(batch.has_summary);
  batch = site.requested(2);
  EXPECT_THAT(batch.tiles, ElementsAre(5));
  EXPECT_TRUE(batch.has_summary);
  batch = site.requested(2);
  EXPECT_THAT(batch.tiles, IsEmpty());
  EXPECT_FALSE(batch.has_summary);
}

TEST(Publication, OfAnotherMapIsNothing) {
  Publication site = publication();
  EXPECT_THAT(site.ask({"mirror", "annex", 1, {0}}), ElementsAre("map_id is of another map"));
  EXPECT_FALSE(site.requested(9).has_summary);
  EXPECT_THAT(site.ask({"mirror", "", 2, {}}), IsEmpty());
  EXPECT_TRUE(site.requested(9).has_summary);
}

}  // namespace
}  // namespace aisle::map
