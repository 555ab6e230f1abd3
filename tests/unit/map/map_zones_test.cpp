// Zones of the map: what the store takes, keeps in its journal and has published.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "services/map/core/map_store.hpp"
#include "services/map/core/publication.hpp"
#include "tests/unit/map/temporary_folder.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;
using fleet::MapEditResult;
using fleet::Zone;
using fleet::ZoneEdit;
using Outcome = MapEditResult::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// 20 m x 10 m.
SiteMap floor_map() { return {"site", grid::OccupancyGrid(grid::Geometry{200, 100, 0.1, {0.0, 0.0}})}; }

Zone zone(const std::string& id, Zone::Kind kind = Zone::Kind::kParking) {
  return {id, kind, Zone::Shape::kPolygon, {{1.0, 1.0 / 3.0}, {4.0, 1.0}, {2.0, 3.0}}};
}

Zone one_way(const std::string& id) {
  Zone made = zone(id, Zone::Kind::kOneWay);
  made.direction_rad = -1.5;
  return made;
}

ZoneEdit add(const std::string& edit_id, const Zone& zone) { return {edit_id, "site", ZoneEdit::Action::kAdd, zone}; }

ZoneEdit remove(const std::string& edit_id, const std::string& zone_id) {
  ZoneEdit edit{edit_id, "site", ZoneEdit::Action::kRemove, {}};
  edit.zone.id = zone_id;
  return edit;
}

MapEdit block(const std::string& id) {
  return {id, "site", MapEdit::Action::kBlock, MapEdit::Shape::kRectangle, {{5.0, 5.0}, {6.0, 6.0}}, 0.0};
}

class MapZones : public ::testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "site.journal"; }

  std::unique_ptr<Journal> journal(const std::vector<Zone>& zones = {}, std::int64_t max_bytes = 1 << 20) const {
    return std::make_unique<Journal>(file(), "site", floor_map().summary().hash,
                                     Journal::Options{max_bytes, hash_of(zones)});
  }

  /// A store that keeps its edits in the journal.
  MapStore store(const std::vector<Zone>& zones = {}) const { return {floor_map(), journal(zones), {}, zones}; }

  testing::TemporaryFolder folder_;
};

TEST_F(MapZones, AreAddedAndRemovedInTheMapsRevisions) {
  MapStore site = store({zone("m")});
  EXPECT_EQ(site.zones().revision, 1U);

  const MapStore::Answer added = site.take(add("e1", one_way("b")), "test", 1);
  EXPECT_EQ(added.result.outcome, Outcome::kApplied);
  EXPECT_EQ(added.result.revision, 2U);
  EXPECT_EQ(added.result.changed_cells, 0U);
  EXPECT_TRUE(added.zones_changed);
  EXPECT_THAT(added.changed_tiles, IsEmpty());
  EXPECT_THAT(site.zones().zones, ElementsAre(one_way("b"), zone("m")));

  EXPECT_EQ(site.take(block("e2"), "test", 2).result.revision, 3U);
  EXPECT_EQ(site.zones().revision, 2U) << "no zone changed";

  EXPECT_EQ(site.take(remove("e3", "m"), "test", 3).result.revision, 4U);
  EXPECT_THAT(site.zones().zones, ElementsAre(one_way("b")));
  EXPECT_EQ(site.zones().revision, 4U);
  EXPECT_EQ(site.map().revision(), 4U);
}

TEST_F(MapZones, AnEditIsAppliedOnce) {
  MapStore site = store();
  site.take(add("e1", zone("a")), "test", 1);

  const MapStore::Answer again = site.take(add("e1", zone("a")), "test", 2);
  EXPECT_EQ(again.result.outcome, Outcome::kAlreadyApplied);
  EXPECT_EQ(again.result.revision, 2U);
  EXPECT_FALSE(again.zones_changed);

  EXPECT_THAT(site.take(add("e1", zone("b")), "test", 3).result.detail, HasSubstr("edit_id was used before"));
  EXPECT_THAT(site.take(block("e1"), "test", 4).result.detail, HasSubstr("edit_id was used before"));
  EXPECT_EQ(site.map().revision(), 2U);
}

TEST_F(MapZones, RefusalsSayWhyAndChangeNothing) {
  MapStore site = store({zone("a")});
  const auto refusal = [&](const ZoneEdit& edit) {
    const MapStore::Answer answer = site.take(edit, "test", 1);
    EXPECT_EQ(answer.result.outcome, Outcome::kRefused);
    EXPECT_FALSE(answer.zones_changed);
    return answer.result.detail;
  };

  EXPECT_THAT(refusal(add("e", zone("a"))), HasSubstr("zone 'a' is on this map already"));
  EXPECT_THAT(refusal(remove("e", "b")), HasSubstr("no zone 'b' on this map"));

  Zone far = zone("far");
  for (geometry::Point2& point : far.points_in_map) point.x += 100.0;
  EXPECT_THAT(refusal(add("e", far)), HasSubstr("zone 'far' lies outside the map"));

  Zone slow = zone("slow", Zone::Kind::kSpeed);
  EXPECT_THAT(refusal(add("e", slow)), HasSubstr("max_speed_mps = 0 is not within"));

  ZoneEdit elsewhere = add("e", zone("b"));
  elsewhere.map_id = "other";
  EXPECT_THAT(refusal(elsewhere), HasSubstr("map 'other' is not served here"));
  EXPECT_THAT(refusal(add("", zone("b"))), HasSubstr("edit_id is empty"));

  EXPECT_THAT(site.zones().zones, ElementsAre(zone("a")));
  EXPECT_EQ(site.map().revision(), 1U);
}

TEST_F(MapZones, AreNoMoreThanAMapMayHave) {
  std::vector<Zone> zones;
  for (std::size_t i = 0; i < fleet::kMostZones; ++i) zones.push_back(zone("z" + std::to_string(i)));
  MapStore site(floor_map(), nullptr, {}, zones);

  EXPECT_THAT(site.take(add("e", zone("more")), "test", 1).result.detail, HasSubstr("256 zones, the most allowed"));
}

TEST_F(MapZones, AreTheSameAfterARestart) {
  Zone disc{"disc", Zone::Kind::kSpeed, Zone::Shape::kDisc, {{7.0, 7.0}}, 1.25, 0.3};
  {
    MapStore site = store({zone("m")});
    site.take(add("e1", one_way("b")), "test", 1);
    site.take(block("e2"), "test", 2);
    site.take(remove("e3", "m"), "test", 3);
    site.take(add("e4", disc), "test", 4);
  }

  MapStore site = store({zone("m")});
  EXPECT_EQ(site.map().revision(), 5U);
  EXPECT_EQ(site.zones().revision, 5U);
  EXPECT_THAT(site.zones().zones, ElementsAre(one_way("b"), disc));
  EXPECT_EQ(site.edits(), 4U);
  EXPECT_EQ(site.take(add("e1", one_way("b")), "test", 5).result.outcome, Outcome::kAlreadyApplied);
}

TEST_F(MapZones, AJournalBelongsToItsFileOfZones) {
  { store({zone("m")}); }

  EXPECT_THROW(journal({zone("n")}), config::BadInput);
  EXPECT_THROW(journal(), config::BadInput);
  EXPECT_NO_THROW(journal({zone("m")}));
}

TEST_F(MapZones, AJournalThatIsFullRefusesAndTheZonesStay) {
  MapStore site(floor_map(), journal({}, 80000), {});
  std::string reason;
  for (int i = 0; i < 5000 && reason.empty(); ++i) {
    const std::string n = std::to_string(i);
    reason = site.take(add("add" + n, zone("a")), "test", 1).result.detail;
    if (reason.empty()) reason = site.take(remove("remove" + n, "a"), "test", 1).result.detail;
  }

  EXPECT_THAT(reason, HasSubstr("cannot keep it"));
  const std::uint64_t revision = site.map().revision();
  const std::vector<Zone> zones = site.zones().zones;

  EXPECT_EQ(site.take(add("more", zone("b")), "test", 1).result.outcome, Outcome::kRefused);
  EXPECT_EQ(site.map().revision(), revision);
  EXPECT_EQ(site.zones().zones, zones);
}

/// Runs SQL on the journal as something else might.
void tamper(const std::filesystem::path& file, const char* sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
  sqlite3_close(database);
}

TEST_F(MapZones, AJournalThatMakesNoSenseIsRefused) {
  const auto with = [this](const char* sql) {
    std::filesystem::remove(file());
    {
      MapStore site = store();
      site.take(add("e1", zone("a")), "test", 1);
      site.take(block("e2"), "test", 2);
      site.take(remove("e3", "a"), "test", 3);
    }
    tamper(file(), sql);

    try {
      store();
    } catch (const config::BadInput& error) {
      return std::string(error.what());
    }

    return std::string("was taken");
  };

  EXPECT_THAT(with("UPDATE zone_edits SET kind = 9 WHERE revision = 2"), HasSubstr("unknown action, kind or shape"));
  EXPECT_THAT(with("UPDATE zone_edits SET points = x'00' WHERE revision = 2"), HasSubstr("does not fit the map"));
  EXPECT_THAT(with("DELETE FROM zone_edits WHERE revision = 2"), HasSubstr("has revision 3"));
  EXPECT_THAT(with("DELETE FROM edits"), HasSubstr("does not follow on the one before"));
  EXPECT_THAT(with("UPDATE zone_edits SET zone_id = 'b' WHERE revision = 4"), HasSubstr("no zone 'b'"));
}

TEST_F(MapZones, AJournalFromBeforeThereWereZonesIsTaken) {
  {
    MapStore site = store();
    site.take(block("e1"), "test", 1);
  }
  tamper(file(), "DROP TABLE zone_edits; DELETE FROM about WHERE name = 'zones_hash'");

  MapStore site = store();
  EXPECT_EQ(site.map().revision(), 2U);
  EXPECT_EQ(site.take(add("e2", zone("a")), "test", 2).result.revision, 3U);
}

TEST_F(MapZones, ArePublishedWhenTheyChange) {
  Publication site(MapStore(floor_map(), nullptr, {}, {zone("a")}));
  EXPECT_TRUE(site.whole().has_zones);

  site.take(add("e1", zone("b")), "test", 1);
  Batch batch = site.changes();
  EXPECT_TRUE(batch.has_zones);
  EXPECT_TRUE(batch.has_summary);
  EXPECT_THAT(batch.tiles, IsEmpty());
  ASSERT_EQ(batch.results.size(), 1U);

  site.take(add("e1", zone("b")), "test", 2);
  batch = site.changes();
  EXPECT_FALSE(batch.has_zones);
  EXPECT_FALSE(batch.has_summary);
  EXPECT_EQ(batch.results.size(), 1U);

  site.take(block("e2"), "test", 3);
  EXPECT_FALSE(site.changes().has_zones);
}

}  // namespace
}  // namespace aisle::map
