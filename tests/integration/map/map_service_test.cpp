#include "services/map/map_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include "tests/integration/map/site_fixture.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;
using fleet::MapEditResult;
using ::testing::HasSubstr;
using testing::local_settings;
using testing::rectangle;
using testing::Site;
using ::testing::StartsWith;
using Action = MapEdit::Action;

constexpr int kDomain = 161;  // and the next ones

grid::OccupancyGrid floor_plan() {
  grid::OccupancyGrid grid(grid::Geometry{300, 200, 0.1, {-5.0, 0.0}});
  for (int x = 20; x < 250; ++x) grid.set({x, 100}, grid::Occupancy::kOccupied);
  return grid;
}

/// The service with a bus of its own, run by the test's loop.
struct Service {
  explicit Service(int domain, std::uint64_t revision = 1)
      : bus(local_settings(domain, "map")),
        shell(bus, {"map", "map", "", 1, "", 0},
              {std::make_shared<spdlog::logger>("map", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)), {}, {}}),
        map(shell, MapStore(SiteMap("floor", floor_plan(), revision), nullptr, {})) {}
  bus::DdsBus bus;
  std::ostringstream log;
  service::Shell shell;
  service::Health& health{shell.health()};
  MapService map;
};

TEST(MapService, MirrorsGetTheMapAndItsEdits) {
  Service service(kDomain);
  Site site(kDomain);
  const auto run = [&](const std::function<bool()>& done) {
    return testing::run_until({&service.bus, &site.bus}, done);
  };
  int maps = 0;
  grid::Cell low, high;
  site.map.on_map(
      [&](const grid::OccupancyGrid& grid, const grid::ClearanceField& clearance, grid::Cell l, grid::Cell h) {
        ++maps;
        low = l;
        high = h;
        const grid::ClearanceField anew(grid);
        for (int x = 0; x < 300; ++x)
          ASSERT_EQ(clearance.clearance_m(grid::Cell{x, 60}), anew.clearance_m(grid::Cell{x, 60}));
      });
  ASSERT_TRUE(run([&] { return site.map.is_complete(); }));
  EXPECT_EQ(site.map.grid().cells(), floor_plan().cells());
  EXPECT_EQ(site.map.map_id(), "floor");
  EXPECT_EQ(site.map.revision(), 1U);
  EXPECT_EQ(high, (grid::Cell{299, 199}));
  EXPECT_EQ(service.health.state, fleet::ServiceState::kReady);

  ASSERT_TRUE(run([&] { return site.can_send(); }));
  site.send(rectangle("wall", Action::kBlock, {0.0, 5.0}, {1.0, 6.0}));
  ASSERT_TRUE(run([&] { return site.results.count("wall") > 0 && site.map.revision() == 2; }));
  EXPECT_EQ(site.results["wall"].outcome, MapEditResult::Outcome::kApplied);
  EXPECT_EQ(site.results["wall"].revision, 2U);
  EXPECT_EQ(site.results["wall"].changed_cells, 100U);
  EXPECT_EQ(site.map.grid().cells(), service.map.store().map().grid().cells());
  EXPECT_EQ(site.map.hash(), service.health.map_hash);
  EXPECT_EQ(low, (grid::Cell{50, 50}));
  EXPECT_EQ(high, (grid::Cell{59, 59}));
  EXPECT_EQ(maps, 2);
  EXPECT_EQ(service.health.counters["tiles_written"], 20U + 1U) << "only the tile that changed";

  Site late(kDomain, "late");
  ASSERT_TRUE(testing::run_until({&service.bus, &site.bus, &late.bus}, [&] { return late.map.is_complete(); }));
  EXPECT_EQ(late.map.grid().cells(), site.map.grid().cells());
  EXPECT_EQ(late.map.revision(), 2U);
}

fleet::ZoneEdit add_zone(const std::string& edit_id, const std::string& zone_id) {
  return {edit_id,
          "floor",
          fleet::ZoneEdit::Action::kAdd,
          {zone_id, fleet::Zone::Kind::kKeepOut, fleet::Zone::Shape::kRectangle, {{1.0, 1.0}, {3.0, 4.0}}}};
}

TEST(MapService, MirrorsGetItsZonesAndTheirEdits) {
  Service service(kDomain + 11);
  Site site(kDomain + 11);
  std::vector<bus::Bus*> buses{&service.bus, &site.bus};
  std::vector<std::size_t> heard;
  site.map.on_zones([&](const std::vector<fleet::Zone>& zones) { heard.push_back(zones.size()); });

  ASSERT_TRUE(
      testing::run_until(buses, [&] { return site.map.is_complete() && site.map.has_zones() && site.can_send(); }));
  EXPECT_TRUE(heard.empty()) << "the map has none";

  // A zone is there before its result is, and the map's revision counts it.
  const fleet::ZoneEdit edit = add_zone("z1", "office");
  site.send(edit);
  ASSERT_TRUE(testing::run_until(buses, [&] { return site.results.count("z1") > 0 && site.map.revision() == 2; }));
  EXPECT_EQ(site.results["z1"].outcome, MapEditResult::Outcome::kApplied);
  EXPECT_EQ(site.map.zones(), std::vector<fleet::Zone>{edit.zone});

  site.send(add_zone("z2", "office"));
  ASSERT_TRUE(testing::run_until(buses, [&] { return site.results.count("z2") > 0; }));
  EXPECT_EQ(site.results["z2"].detail, "zone 'office' is on this map already: remove it first, or take another id");

  Site late(kDomain + 11, "late");
  buses.push_back(&late.bus);
  ASSERT_TRUE(testing::run_until(buses, [&] { return late.map.has_zones(); }));
  EXPECT_EQ(late.map.zones(), site.map.zones());

  fleet::ZoneEdit removal = add_zone("z3", "office");
  removal.action = fleet::ZoneEdit::Action::kRemove;
  site.send(removal);
  ASSERT_TRUE(testing::run_until(buses, [&] { return late.map.zones().empty() && site.map.zones().empty(); }));
  EXPECT_EQ(heard, (std::vector<std::size_t>{1, 0}));
}

TEST(MapClient, TakesZonesOnlyFromTheServiceThatSaysTheMap) {
  Service service(kDomain + 12);
  Site site(kDomain + 12);
  bus::DdsBus other(local_settings(kDomain + 12, "intruder"));
  auto writer = other.writer<topics::MapZones>();
  const std::vector<bus::Bus*> buses{&service.bus, &site.bus, &other};

  ASSERT_TRUE(testing::run_until(
      buses, [&] { return site.map.is_complete() && site.map.has_zones() && writer.matched_readers() > 0; }));

  aisle::MapZones sample = wire::encode(fleet::MapZones{"floor", 99, {add_zone("z", "forged").zone}});
  sample.by().source_id("intruder");
  writer.write(sample);

  ASSERT_TRUE(testing::run_until(
      buses, [&] { return site.map.dropped().count("map_zones: of another source: intruder") > 0; }));
  EXPECT_TRUE(site.map.zones().empty());
}

TEST(MapClient, DropsZonesThatCameBeforeTheMapOfAnotherId) {
  bus::DdsBus server(local_settings(kDomain + 13, "two-maps"));
  bus::DdsBus bus(local_settings(kDomain + 13, "mirror"));
  service::MapClient client(bus, "mirror", {});
  auto zones = server.writer<topics::MapZones>();
  auto info = server.writer<topics::MapInfo>();
  std::vector<std::size_t> heard;
  client.on_zones([&](const std::vector<fleet::Zone>& now) { heard.push_back(now.size()); });

  zones.write(wire::encode(fleet::MapZones{"annex", 7, {add_zone("z", "office").zone}}));
  ASSERT_TRUE(testing::run_until({&server, &bus}, [&] { return heard.size() == 1; }));

  info.write(wire::encode(SiteMap("floor", floor_plan()).summary()));
  ASSERT_TRUE(testing::run_until({&server, &bus}, [&] { return heard.size() == 2; }));
  EXPECT_EQ(heard, (std::vector<std::size_t>{1, 0}));
  EXPECT_FALSE(client.has_zones());
}

TEST(MapClient, AHandlerMayAddHandlers) {
  Service service(kDomain + 10);
  Site site(kDomain + 10);
  int added = 0;
  const std::string text = "what the first handler holds";
  std::string seen;
  site.map.on_map([&, text](const grid::OccupancyGrid&, const grid::ClearanceField&, grid::Cell, grid::Cell) {
    for (int i = 0; i < 100; ++i)
      site.map.on_map(
          [&](const grid::OccupancyGrid&, const grid::ClearanceField&, grid::Cell, grid::Cell) { ++added; });
    seen = text;
  });
  const auto run = [&](const std::function<bool()>& done) {
    return testing::run_until({&service.bus, &site.bus}, done);
  };
  ASSERT_TRUE(run([&] { return site.map.is_complete() && site.can_send(); }));
  EXPECT_EQ(seen, text);
  EXPECT_EQ(added, 0) << "from the next map on";
  site.send(rectangle("wall", Action::kBlock, {0.0, 5.0}, {1.0, 6.0}));
  ASSERT_TRUE(run([&] { return site.map.revision() == 2; }));
  EXPECT_EQ(added, 100);
}

TEST(MapService, AnswersEveryEditOnceAndRefusesWithAReason) {
  Service service(kDomain + 1);
  Site site(kDomain + 1);
  const auto run = [&](const std::function<bool()>& done) {
    return testing::run_until({&service.bus, &site.bus}, done);
  };
  ASSERT_TRUE(run([&] { return site.can_send() && site.map.is_complete(); }));
  site.send(rectangle("a", Action::kBlock, {0.0, 5.0}, {1.0, 6.0}));
  site.send(rectangle("b", Action::kUnblock, {0.0, 5.0}, {1.0, 6.0}));
  ASSERT_TRUE(run([&] { return site.results.size() == 2; }));
  site.results.clear();
  site.send(rectangle("a", Action::kBlock, {0.0, 5.0}, {1.0, 6.0}));
  MapEdit foreign = rectangle("foreign", Action::kBlock, {0.0, 5.0}, {1.0, 6.0});
  foreign.map_id = "annex";
  site.send(foreign);
  site.send(rectangle("nan", Action::kBlock, {std::nan(""), 5.0}, {1.0, 6.0}));
  site.send(rectangle("far", Action::kBlock, {0.0, 5.0}, {1e308, 6.0}));
  aisle::MapEdit strange = wire::encode(rectangle("strange", Action::kBlock, {0.0, 5.0}, {1.0, 6.0}));
  strange.shape(static_cast<aisle::EditShape>(77));
  site.send_raw(strange);
  ASSERT_TRUE(run([&] { return site.results.size() == 5; }));
  EXPECT_EQ(site.results["a"].outcome, MapEditResult::Outcome::kAlreadyApplied);
  EXPECT_EQ(site.results["a"].revision, 2U);
  for (const char* id : {"foreign", "nan", "far", "strange"}) {
    EXPECT_EQ(site.results[id].outcome, MapEditResult::Outcome::kRefused) << id;
    EXPECT_NE(site.results[id].detail, "") << id;
    EXPECT_EQ(site.results[id].revision, 3U) << id;
  }
  EXPECT_THAT(site.results["foreign"].detail, HasSubstr("annex"));
  EXPECT_EQ(service.map.store().map().revision(), 3U);
  EXPECT_EQ(service.health.counters["edits_refused"], 4U);
  EXPECT_EQ(service.health.counters["dropped_map_edit"], 3U) << "nan, far and strange";
  EXPECT_THAT(site.results["nan"].detail, StartsWith("points"));
  EXPECT_THAT(site.results["far"].detail, StartsWith("points"));
  EXPECT_THAT(site.results["strange"].detail, StartsWith("shape"));
  EXPECT_THAT(service.health.last_error, HasSubstr("refused"));
}

TEST(MapService, NamesEachEditInTheLogAndHoldsBackAFlood) {
  Service service(kDomain + 4);
  Site site(kDomain + 4);
  const auto run = [&](const std::function<bool()>& done) {
    return testing::run_until({&service.bus, &site.bus}, done);
  };
  ASSERT_TRUE(run([&] { return site.can_send() && site.map.is_complete(); }));
  MapEdit foreign = rectangle("", Action::kBlock, {0.0, 5.0}, {1.0, 6.0});
  foreign.map_id = "annex";
  const auto send = [&](const std::string& id) {
    foreign.edit_id = id;
    site.send(foreign);
  };
  for (int i = 0; i < 12; ++i) send("edit-" + std::to_string(i));
  ASSERT_TRUE(run([&] { return site.results.size() == 12; }));
  for (int i = 0; i < 12; ++i)
    EXPECT_THAT(service.log.str(), HasSubstr("[error] edit=edit-" + std::to_string(i) + " refused reason="));

  const time::Stamp begun = service.bus.now();
  for (int i = 0; i < 200; ++i) {
    send("flood-" + std::to_string(i));
    service.bus.run_once(std::chrono::milliseconds(0));
    site.bus.run_once(std::chrono::milliseconds(0));
  }
  ASSERT_TRUE(run([&] { return service.health.counters["edits_refused"] == 212; }));
  const double seconds = time::seconds(service.bus.now() - begun);
  const std::string log = service.log.str();
  int lines = 0;
  for (std::size_t at = log.find("edit=flood-"); at != std::string::npos; at = log.find("edit=flood-", at + 1)) ++lines;
  EXPECT_LE(lines, 20 * (static_cast<int>(seconds) + 2)) << "in " << seconds << " s";
}

TEST(MapService, WritesTilesAgainForWhoMissesThem) {
  Service service(kDomain + 2);
  bus::DdsBus other(local_settings(kDomain + 2, "asker"));
  auto requests = other.writer<topics::MapRequest>();
  int tiles = 0;
  int infos = 0;
  other.on<topics::MapTile>([&](const aisle::MapTile&, const bus::SampleInfo&) { ++tiles; });
  other.on<topics::MapInfo>([&](const aisle::MapInfo&, const bus::SampleInfo&) { ++infos; });
  const auto run = [&](const std::function<bool()>& done) { return testing::run_until({&service.bus, &other}, done); };
  ASSERT_TRUE(run([&] { return tiles == 20 && infos == 1 && requests.matched_readers() > 0; }));
  requests.write(wire::encode(fleet::MapRequest{"asker", "floor", 1, {3, 7, 7, 4000000000U}}));
  ASSERT_TRUE(run([&] { return tiles == 22 && infos == 2; }));
  requests.write(wire::encode(fleet::MapRequest{"asker", "annex", 2, {3}}));
  requests.write(wire::encode(fleet::MapRequest{"asker", "", 3, {}}));
  ASSERT_TRUE(run([&] { return infos == 3; }));
  EXPECT_EQ(tiles, 22);
  EXPECT_EQ(service.health.counters["bad_map_request.map_id"], 1U);
  EXPECT_EQ(service.health.counters["bad_map_request.tiles"], 1U);
}

TEST(MapClient, AsksForTilesThatDoNotComeAndIgnoresOtherMaps) {
  // A map_info whose tiles nobody wrote: only the client's asking brings them.
  bus::DdsBus server(local_settings(kDomain + 3, "half-a-map"));
  const SiteMap truth("floor", floor_plan());
  const SiteMap annex("annex", floor_plan());
  auto info = server.writer<topics::MapInfo>();
  auto tiles = server.writer<topics::MapTile>();
  std::vector<std::uint32_t> asked;
  server.on<topics::MapRequest>([&](const aisle::MapRequest& sample, const bus::SampleInfo&) {
    const auto request = wire::decode(sample);
    ASSERT_TRUE(request) << request.reason();
    EXPECT_EQ(request->requester_id, "mirror");
    asked = request->tiles;
    for (const std::uint32_t tile : request->tiles) tiles.write(wire::encode(truth.tile(static_cast<int>(tile))));
  });
  bus::DdsBus bus(local_settings(kDomain + 3, "mirror"));
  service::MapClient::Options options;
  options.map_id = "floor";
  options.with_clearance = false;
  service::MapClient client(bus, "mirror", options);
  info.write(wire::encode(annex.summary()));
  info.write(wire::encode(truth.summary()));
  for (int i = 0; i < truth.tiles() - 3; ++i) tiles.write(wire::encode(truth.tile(i)));
  aisle::MapTile broken = wire::encode(truth.tile(truth.tiles() - 1));
  broken.cells()[0] = 9;
  tiles.write(broken);
  ASSERT_TRUE(testing::run_until({&server, &bus}, [&] { return client.is_complete(); }));
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{17, 18, 19}));
  EXPECT_EQ(client.grid().cells(), truth.grid().cells());
  EXPECT_EQ(client.dropped().at("map of another id: annex"), 1U);
  EXPECT_GE(client.dropped().size(), 2U) << "and the broken tile";
}

}  // namespace
}  // namespace aisle::map
