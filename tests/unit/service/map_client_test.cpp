// When the map's client calls its handlers: on a simulated network, in virtual time.
#include "common/service/map_client.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/simulated/network.hpp"
#include "common/grid/tiles.hpp"
#include "common/wire/map.hpp"

namespace aisle::service {
namespace {

using namespace std::chrono_literals;

bus::Settings named(const std::string& name) {
  bus::Settings settings;
  settings.participant_name = name;
  return settings;
}

/// A process that says a map of 10 x 8 cells, and one that mirrors it.
struct Mirrored {
  Mirrored() {
    server->drive();
    mirror->drive();
    client.on_map([this](const auto&, const auto&, grid::Cell low, grid::Cell high) {
      told += "map from " + std::to_string(low.x) + " to " + std::to_string(high.x) + "\n";
    });
    client.on_zones([this](const auto& heard) { told += std::to_string(heard.size()) + " zones\n"; });
    pass(100ms);
  }

  void pass(std::chrono::nanoseconds time) { network.advance_to(network.now() + time); }

  /// `corner`: of the cell at (9, 7).
  void say_map(std::uint64_t revision, grid::Occupancy corner) {
    grid::OccupancyGrid grid(grid::Geometry{10, 8, 0.1, {0.0, 0.0}});
    grid.set({9, 7}, corner);

    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = revision;
    summary.tiling = {64, grid.geometry()};
    grid::Tile tile{"hall", 0, 0, revision, 0, grid::tile_cells(grid, summary.tiling, 0)};
    tile.hash = grid::tile_hash(tile.cells);
    summary.tile_hashes = {tile.hash};
    summary.hash = grid::map_hash(summary.tile_hashes);

    tiles.write(wire::encode(tile));
    infos.write(wire::encode(summary));
  }

  void say_zone() {
    const fleet::Zone zone{"office", fleet::Zone::Kind::kKeepOut, fleet::Zone::Shape::kDisc, {{1.0, 1.0}}, 0.5};
    zones.write(wire::encode(fleet::MapZones{"hall", 1, {zone}}));
  }

  bus::simulated::Network network{1};
  std::unique_ptr<bus::simulated::SimulatedBus> server{network.join(named("server"), "a")};
  std::unique_ptr<bus::simulated::SimulatedBus> mirror{network.join(named("mirror"), "b")};
  bus::Writer<topics::MapTile> tiles{server->writer<topics::MapTile>()};
  bus::Writer<topics::MapInfo> infos{server->writer<topics::MapInfo>()};
  bus::Writer<topics::MapZones> zones{server->writer<topics::MapZones>()};
  MapClient client{*mirror, "mirror", {}};
  std::string told;
};

TEST(MapClient, TellsTheFirstMapAfterItsZones) {
  Mirrored site;
  site.say_map(1, grid::Occupancy::kFree);
  site.pass(500ms);
  EXPECT_TRUE(site.client.is_complete());
  EXPECT_EQ(site.told, "");

  site.say_zone();
  site.pass(50ms);
  EXPECT_EQ(site.told, "1 zones\nmap from 0 to 9\n");
}

TEST(MapClient, DoesNotWaitLongForZonesThatNoServiceSays) {
  Mirrored site;
  site.say_map(1, grid::Occupancy::kFree);
  site.pass(1200ms);

  EXPECT_EQ(site.told, "map from 0 to 9\n");
  EXPECT_FALSE(site.client.has_zones());
}

TEST(MapClient, AMapThatChangedWhileItWasHeldBackIsToldWhole) {
  Mirrored site;
  site.say_map(1, grid::Occupancy::kFree);
  site.pass(300ms);
  site.say_map(2, grid::Occupancy::kOccupied);
  site.pass(300ms);
  EXPECT_EQ(site.told, "");

  site.say_zone();
  site.pass(50ms);
  EXPECT_EQ(site.told, "1 zones\nmap from 0 to 9\n");

  site.say_map(3, grid::Occupancy::kFree);
  site.pass(50ms);
  EXPECT_EQ(site.told, "1 zones\nmap from 0 to 9\nmap from 9 to 9\n");
}

}  // namespace
}  // namespace aisle::service
