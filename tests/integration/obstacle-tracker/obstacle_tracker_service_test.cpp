// The service on a bus of its own domain; the test plays the map and the vehicles.
#include "services/obstacle-tracker/obstacle_tracker_service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/process/clock.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"
#include "common/wire/vehicle.hpp"
#include "tests/integration/bus/two_buses.hpp"
#include "tests/unit/obstacle-tracker/simulated_lidar.hpp"

namespace aisle::obstacle_tracker {
namespace {

using namespace std::chrono_literals;
using bus::SampleInfo;
using bus::SampleKind;

bus::Settings site(int domain, const std::string& name) {
  bus::Settings settings = bus_test::loopback(domain, name);
  settings.partition = "tracker-test-" + std::to_string(getpid());  // beside the same test in another process
  return settings;
}

/// One tracker process.
struct TrackerProcess {
  TrackerProcess(int domain, std::uint64_t boot_id, const ServiceParams& params = {})
      : bus(site(domain, "tracker")),
        shell(bus, {"obstacle-tracker", "tracker", "", boot_id, "", 0}),
        service(shell, params) {}
  bus::DdsBus bus;
  service::Shell shell;
  service::Health& health{shell.health()};
  ObstacleTrackerService service;
};

/// The rest of a site: a room of 16 x 12 m and vehicles that scan it, each every 10 ms so that tests are short.
class Site {
 public:
  explicit Site(int domain)
      : bus(site(domain, "site")),
        world(test::room(16.0, 12.0)),
        lidar_(1),
        infos_(bus.writer<topics::MapInfo>()),
        tiles_(bus.writer<topics::MapTile>()),
        vehicle_infos_(bus.writer<topics::VehicleInfo>()),
        states_(bus.writer<topics::VehicleState>()),
        scans_(bus.writer<topics::Scan>()) {
    bus.on<topics::Track>([this](const aisle::Track& sample, const SampleInfo& info) {
      if (info.kind == SampleKind::kData) {
        tracks[sample.track_id()] = sample;
      } else if (info.kind == SampleKind::kDisposed) {
        tracks.erase(sample.track_id());
        ++disposed;
      }
    });
    bus.on<topics::TrackingStatus>([this](const aisle::TrackingStatus& sample, const SampleInfo& info) {
      if (info.kind == SampleKind::kData) status = sample;
    });
    bus.on<topics::Coverage>([this](const aisle::Coverage& sample, const SampleInfo& info) {
      if (info.kind == SampleKind::kData) coverage = sample;
    });
    bus.every(10ms, [this] { publish_vehicles(); });
  }

  void publish_map() {
    grid::MapSummary summary;
    summary.map_id = "room";
    summary.revision = 1;
    summary.tiling = {64, world.grid.geometry()};
    for (int i = 0; i < summary.tiling.count(); ++i) {
      grid::Tile tile;
      tile.map_id = "room";
      tile.tile_x = i % summary.tiling.tiles_x();
      tile.tile_y = i / summary.tiling.tiles_x();
      tile.revision = 1;
      tile.cells = grid::tile_cells(world.grid, summary.tiling, i);
      tile.hash = grid::tile_hash(tile.cells);
      summary.tile_hashes.push_back(tile.hash);
      tiles_.write(wire::encode(tile));
    }
    summary.hash = grid::map_hash(summary.tile_hashes);
    aisle::MapInfo sample = wire::encode(summary);
    sample.by(origin_.next());
    infos_.write(sample);
  }

  void publish_info(const std::string& agv_id) {
    aisle::VehicleInfo info = wire::encode(fleet::Vehicle{agv_id, geometry::disc(0.35), {}, 10.0, 0.2});
    info.by(origin_.next());
    vehicle_infos_.write(info);
  }

  bus::DdsBus bus;
  test::World world;
  std::vector<test::Vehicle> fleet;
  std::string broken_scans_of;  // get a pose that is no number
  std::map<std::uint64_t, aisle::Track> tracks;
  int disposed{0};
  aisle::TrackingStatus status;
  aisle::Coverage coverage;

 private:
  void publish_vehicles() {
    for (const test::Vehicle& vehicle : fleet) {
      aisle::VehicleState state;
      state.agv_id(vehicle.agv_id);
      state.by(origin_.next());
      state.base_in_map(wire::encode(vehicle.base_in_map));
      states_.write(state);
      const Scan scan = lidar_.scan(world, vehicle, fleet, {});
      aisle::Scan sample;
      sample.agv_id(vehicle.agv_id);
      sample.by(origin_.next());
      sample.base_in_map(wire::encode(scan.base_in_map));
      if (vehicle.agv_id == broken_scans_of) sample.base_in_map().x_m(std::numeric_limits<double>::quiet_NaN());
      sample.first_angle_rad(scan.first_angle_rad);
      sample.angle_step_rad(scan.angle_step_rad);
      sample.range_min_m(scan.range_min_m);
      sample.range_max_m(scan.range_max_m);
      sample.ranges_m(scan.ranges_m);
      scans_.write(sample);
    }
  }

  test::Lidar lidar_;
  service::OriginStamper origin_{bus, "site", 1};
  bus::Writer<topics::MapInfo> infos_;
  bus::Writer<topics::MapTile> tiles_;
  bus::Writer<topics::VehicleInfo> vehicle_infos_;
  bus::Writer<topics::VehicleState> states_;
  bus::Writer<topics::Scan> scans_;
};

test::Vehicle vehicle_at(const char* id, double x, double y) { return {id, {x, y, 0.0}, {}, 0.35, 10.0, 360}; }

TEST(ObstacleTrackerService, TracksWhatTwoVehiclesSeeAndDisposesItWhenItIsGone) {
  TrackerProcess tracker(160, 1'790'000'000'000'000);
  Site site(160);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&tracker.bus, &site.bus}, done);
  };
  site.publish_map();
  site.fleet = {vehicle_at("agv-1", 4.0, 3.0), vehicle_at("agv-2", 12.0, 3.0)};
  site.publish_info("agv-1");
  site.publish_info("agv-2");
  site.world.discs = {{{8.0, 6.0}, 0.25}};
  ASSERT_TRUE(until(
      [&] { return !site.tracks.empty() && site.status.newest_scans().size() == 2 && site.status.scans_used() > 20; }));
  ASSERT_EQ(site.tracks.size(), 1U);  // and neither vehicle is an obstacle to the other
  const aisle::Track& track = site.tracks.begin()->second;
  EXPECT_NEAR(track.position_in_map().x_m(), 8.0, 0.15);
  EXPECT_NEAR(track.position_in_map().y_m(), 6.0, 0.15);
  EXPECT_NEAR(track.radius_m(), 0.27, 0.1);
  EXPECT_GT(track.scan_stamp_ns(), 0);
  EXPECT_GT(track.by().sequence_number(), 0U);
  ASSERT_EQ(site.status.live_track_ids().size(), 1U);
  EXPECT_EQ(site.status.live_track_ids()[0], track.track_id());
  EXPECT_GT(site.status.processing_ms(), 0.0);
  ASSERT_TRUE(until([&] { return tracker.health.state == fleet::ServiceState::kReady; })) << tracker.health.waits_for;

  site.world.discs.clear();
  ASSERT_TRUE(until([&] { return site.disposed == 1; }));
  EXPECT_TRUE(site.tracks.empty());
  ASSERT_TRUE(until([&] { return site.status.live_track_ids().empty(); }));
}

TEST(ObstacleTrackerService, StartsBeforeMapAndVehiclesAndSaysWhatItWaitsFor) {
  TrackerProcess tracker(161, 1'790'000'000'000'000);
  Site site(161);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&tracker.bus, &site.bus}, done);
  };
  ASSERT_TRUE(until([&] { return tracker.health.waits_for == "map_info, map_tile, vehicle_info, scan"; }));
  site.fleet = {vehicle_at("agv-1", 4.0, 3.0)};
  ASSERT_TRUE(until([&] { return tracker.health.counters["scans_unknown_vehicle"] > 3; }));
  site.publish_info("agv-1");
  ASSERT_TRUE(until([&] { return tracker.health.counters["scans_no_map"] > 3; }));
  EXPECT_EQ(site.status.scans_used(), 0U);
  EXPECT_EQ(tracker.health.state, fleet::ServiceState::kWaiting);
  site.publish_map();
  ASSERT_TRUE(until([&] { return site.status.scans_used() > 3; }));
  ASSERT_TRUE(until([&] { return tracker.health.waits_for.empty(); }));
}

TEST(ObstacleTrackerService, DropsABrokenScanAndGoesOnWithTheOthers) {
  TrackerProcess tracker(162, 1'790'000'000'000'000);
  Site site(162);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&tracker.bus, &site.bus}, done);
  };
  site.publish_map();
  site.fleet = {vehicle_at("agv-1", 4.0, 3.0), vehicle_at("agv-2", 12.0, 3.0)};
  site.broken_scans_of = "agv-1";
  site.publish_info("agv-1");
  site.publish_info("agv-2");
  ASSERT_TRUE(until([&] { return site.status.scans_used() > 5 && tracker.health.counters["scans_not_finite"] > 5; }));
  ASSERT_TRUE(until([&] { return site.status.scans_dropped() > 5; }));
  ASSERT_EQ(site.status.newest_scans().size(), 1U);
  EXPECT_EQ(site.status.newest_scans()[0].agv_id().to_string(), "agv-2");
}

TEST(ObstacleTrackerService, TellsWhatWasSeenAlsoToWhoComesLate) {
  TrackerProcess tracker(164, 1'790'000'000'000'000);
  Site site(164);
  site.world = test::World(test::room(16.0, 12.0));
  test::fill(site.world.grid, {10.0, 0.0}, {10.2, 12.0});  // nobody is beyond this wall
  site.world.clearance = grid::ClearanceField(site.world.grid);
  site.publish_map();
  site.fleet = {vehicle_at("agv-1", 4.0, 6.0)};
  site.publish_info("agv-1");
  ASSERT_TRUE(bus_test::run_until({&tracker.bus, &site.bus}, [&] { return !site.coverage.ages().empty(); }));

  Site late(164);
  ASSERT_TRUE(bus_test::run_until({&tracker.bus, &late.bus}, [&] { return !late.coverage.ages().empty(); }));
  const aisle::Coverage& tile = late.coverage;
  EXPECT_EQ(tile.source_id().to_string(), "tracker");
  EXPECT_EQ(tile.map_id().to_string(), "room");
  ASSERT_EQ(tile.width_cells(), 32U);
  ASSERT_EQ(tile.height_cells(), 24U);
  const auto age_at = [&](std::size_t x, std::size_t y) {
    return static_cast<int>(tile.ages()[y * tile.width_cells() + x]);
  };
  EXPECT_LT(age_at(12, 12), 254);         // (6.25, 6.25)
  EXPECT_EQ(age_at(26, 12), kNeverSeen);  // (13.25, 6.25)
}

TEST(ObstacleTrackerService, HearsOnlyTheVehicleThatItIsFor) {
  ServiceParams params;
  params.only_scans_of = "agv-2";
  TrackerProcess tracker(165, 1'790'000'000'000'000, params);
  Site site(165);
  site.publish_map();
  site.fleet = {vehicle_at("agv-1", 4.0, 3.0), vehicle_at("agv-2", 12.0, 3.0)};
  site.publish_info("agv-1");
  site.publish_info("agv-2");
  ASSERT_TRUE(bus_test::run_until({&tracker.bus, &site.bus}, [&] { return site.status.scans_used() > 10; }));
  ASSERT_EQ(site.status.newest_scans().size(), 1U);
  EXPECT_EQ(site.status.newest_scans()[0].agv_id().to_string(), "agv-2");
}

TEST(ObstacleTrackerService, UsesOtherIdsAfterARestart) {
  Site site(163);
  site.publish_map();
  site.fleet = {vehicle_at("agv-1", 4.0, 3.0)};
  site.publish_info("agv-1");
  site.world.discs = {{{8.0, 6.0}, 0.25}};
  std::set<std::uint64_t> ids;
  for (const std::uint64_t boot_id : {1'790'000'000'000'000ULL, 1'790'000'001'000'000ULL}) {
    TrackerProcess tracker(163, boot_id);
    const auto new_id = [&] {
      return std::find_if(site.tracks.begin(), site.tracks.end(),
                          [&](const auto& track) { return ids.count(track.first) == 0; });
    };
    ASSERT_TRUE(bus_test::run_until({&tracker.bus, &site.bus}, [&] {
      return new_id() != site.tracks.end();
    }));  // the last ones of the other may still come
    ids.insert(new_id()->first);
  }
  EXPECT_EQ(ids.size(), 2U);
  for (const std::uint64_t id : ids) EXPECT_LT(id, 1ULL << 53U);
}

}  // namespace
}  // namespace aisle::obstacle_tracker
