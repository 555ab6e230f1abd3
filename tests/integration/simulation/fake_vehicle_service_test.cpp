// The vehicle on a bus; the test plays the map and the local planner.
#include "services/fake-vehicle/fake_vehicle_service.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "common/grid/map_mirror.hpp"
#include "common/process/clock.hpp"
#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"
#include "common/wire/origin.hpp"
#include "tests/integration/simulation/site.hpp"

namespace aisle::fake_vehicle {
namespace {

using namespace std::chrono_literals;
using simulation_test::Folder;
using simulation_test::run_until;
using simulation_test::site;

constexpr int kDomain = 110;

ServiceConfig standing_at(double x, double y) {
  ServiceConfig config;
  config.run = "test/agv-1";
  config.start_in_map = {x, y, 0.0};
  config.vehicle.pose_noise_m = 0.0;
  config.vehicle.yaw_noise_rad = 0.0;
  return config;
}

struct VehicleProcess {
  VehicleProcess(int domain, std::uint64_t boot_id, const ServiceConfig& config)
      : bus(site(domain, "vehicle")),
        shell(bus, {"fake-vehicle", "fake-vehicle-agv-1", "agv-1", boot_id, "", 0}),
        service(shell, config) {}
  bus::DdsBus bus;
  service::Shell shell;
  service::Health& health{shell.health()};
  FakeVehicleService service;
};

/// The rest of the site: an empty hall of 20 x 10 m, and what the vehicle says.
class Site {
 public:
  explicit Site(int domain)
      : bus(site(domain, "site")),
        infos_(bus.writer<topics::MapInfo>()),
        tiles_(bus.writer<topics::MapTile>()),
        commands_(bus.writer<topics::VelocityCommand>()),
        obstacles_(bus.writer<topics::WorldObstacle>()) {
    bus.on<topics::VehicleInfo>([this](const aisle::VehicleInfo& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData) vehicle_info = sample;
    });
    bus.on<topics::VehicleState>([this](const aisle::VehicleState& sample, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData) return;
      state = sample;
      ++states_of_boot[sample.by().boot_id()];
    });
    bus.on<topics::Scan>([this](const aisle::Scan& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData) scan = sample;
    });
    bus.on<topics::WorldObstacle>([this](const aisle::WorldObstacle& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData && sample.kind() == BodyKind::BODY_VEHICLE) truth = sample;
    });
    publish_map();
    bus.every(20ms, [this] {
      if (speed_mps) command(*speed_mps);
    });
  }

  void command(double linear_mps) {
    aisle::VelocityCommand sample;
    sample.agv_id(std::string("agv-1"));
    sample.by(wire::encode(fleet::Origin{"local-planner-agv-1", 1, epoch, ++sequence_, process::wall_clock_ns()}));
    sample.plan_id(77);
    aisle::Twist twist;
    twist.linear_mps(linear_mps);
    twist.angular_radps(turn_radps);
    twist.sideways_mps(sideways_mps);
    sample.twist(twist);
    commands_.write(sample);
  }

  void command_malformed(const std::string& agv_id) {
    aisle::VelocityCommand sample;
    sample.agv_id(agv_id);
    sample.by(wire::encode(fleet::Origin{"local-planner-agv-1", 1, epoch, ++sequence_, process::wall_clock_ns()}));
    sample.twist().linear_mps(std::nan(""));
    commands_.write(sample);
  }

  void show_person(double x, double y) {
    aisle::WorldObstacle sample;
    sample.obstacle_id(std::string("person"));
    sample.by(wire::encode(fleet::Origin{"world", 1, 1, 1, 0}));
    sample.kind(BodyKind::BODY_PERSON);
    sample.base_in_map(wire::encode(geometry::Pose2{x, y, 0.0}));
    sample.radius_m(0.25);
    obstacles_.write(sample);
  }

  bool drives() const { return state && state->twist().linear_mps() > 0.5; }

  bus::DdsBus bus;
  std::optional<double> speed_mps;  // commanded 50 times a second
  double turn_radps{0.0};
  double sideways_mps{0.0};
  std::uint32_t epoch{1};
  std::optional<aisle::VehicleInfo> vehicle_info;
  std::optional<aisle::VehicleState> state;
  std::optional<aisle::Scan> scan;
  std::optional<aisle::WorldObstacle> truth;
  std::map<std::uint64_t, int> states_of_boot;

 private:
  void publish_map() {
    grid::OccupancyGrid hall(grid::Geometry{400, 200, 0.05, {}});
    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = 1;
    summary.tiling.geometry = hall.geometry();
    for (int i = 0; i < summary.tiling.count(); ++i) {
      grid::Tile tile;
      tile.map_id = summary.map_id;
      tile.tile_x = i % summary.tiling.tiles_x();
      tile.tile_y = i / summary.tiling.tiles_x();
      tile.revision = 1;
      tile.cells = grid::tile_cells(hall, summary.tiling, i);
      tile.hash = grid::tile_hash(tile.cells);
      summary.tile_hashes.push_back(tile.hash);
      tiles_.write(wire::encode(tile));
    }
    summary.hash = grid::map_hash(summary.tile_hashes);
    aisle::MapInfo sample = wire::encode(summary);
    sample.by(origin());
    infos_.write(sample);
  }
  aisle::Origin origin() const { return wire::encode(fleet::Origin{"map", 1, 1, 1, 0}); }

  std::uint64_t sequence_{0};
  bus::Writer<topics::MapInfo> infos_;
  bus::Writer<topics::MapTile> tiles_;
  bus::Writer<topics::VelocityCommand> commands_;
  bus::Writer<topics::WorldObstacle> obstacles_;
};

TEST(FakeVehicleService, IsAForkliftThatDrivesOnlyOnArcs) {
  Site site(kDomain + 8);
  ServiceConfig config = standing_at(3, 5);
  config.vehicle.length_m = 2.4;
  config.vehicle.width_m = 1.1;
  config.vehicle.ahead_m = 0.4;
  config.vehicle.limits.model = kinematics::Model::kTricycle;
  config.vehicle.limits.axle.max_steering_rad = 0.5;
  VehicleProcess vehicle(kDomain + 8, 5, config);
  const auto run = [&](const std::function<bool()>& done) { return run_until({&site.bus, &vehicle.bus}, done); };
  ASSERT_TRUE(run([&] { return site.vehicle_info && site.state && site.truth; }));
  EXPECT_EQ(site.vehicle_info->model(), KinematicModel::MODEL_TRICYCLE);
  EXPECT_EQ(site.vehicle_info->footprint(), FootprintKind::FOOTPRINT_RECTANGLE);
  EXPECT_DOUBLE_EQ(site.vehicle_info->ahead_m(), 0.4);
  EXPECT_DOUBLE_EQ(site.vehicle_info->wheelbase_m(), 1.5);
  EXPECT_EQ(site.truth->shape(), FootprintKind::FOOTPRINT_RECTANGLE);
  EXPECT_DOUBLE_EQ(site.truth->ahead_m(), 0.4);
  EXPECT_NEAR(site.truth->base_in_map().x_m(), 3.0, 1e-9) << "the vehicle's frame, not its middle";

  site.turn_radps = 1.0;  // tighter than it can: the wheel goes to its stop
  site.speed_mps = 1.0;
  ASSERT_TRUE(run([&] { return site.drives() && site.state->steering_rad() > 0.49; }));
  EXPECT_NEAR(site.state->steering_rad(), 0.5, 1e-6);
  EXPECT_NEAR(site.state->twist().angular_radps(), site.state->twist().linear_mps() * std::tan(0.5) / 1.5, 1e-6);
}

TEST(FakeVehicleService, IsACartThatDrivesSideways) {
  Site site(kDomain + 5);
  ServiceConfig config = standing_at(3, 5);
  config.vehicle.limits.model = kinematics::Model::kOmnidirectional;
  VehicleProcess vehicle(kDomain + 5, 5, config);
  site.sideways_mps = 0.5;
  site.speed_mps = 0.0;
  ASSERT_TRUE(run_until({&site.bus, &vehicle.bus},
                        [&] { return site.state && site.truth && site.truth->base_in_map().y_m() > 5.3; }));
  EXPECT_NEAR(site.truth->base_in_map().x_m(), 3.0, 1e-6);
  EXPECT_GT(site.state->twist().sideways_mps(), 0.3);
  EXPECT_GT(site.truth->velocity_y_mps(), 0.3);
}

TEST(FakeVehicleService, IntroducesItselfDrivesAndStopsBySilence) {
  Site site(kDomain);
  VehicleProcess vehicle(kDomain, 5, standing_at(3, 5));
  const auto run = [&](const std::function<bool()>& done) { return run_until({&site.bus, &vehicle.bus}, done); };
  ASSERT_TRUE(run([&] { return site.vehicle_info && site.state && site.scan && site.truth; }));
  EXPECT_DOUBLE_EQ(site.vehicle_info->radius_m(), 0.35);
  EXPECT_EQ(site.scan->ranges_m().size(), 360u);
  EXPECT_EQ(site.state->hold(), HoldReason::HOLD_NO_COMMAND);
  EXPECT_EQ(site.truth->obstacle_id().to_string(), "agv-1");

  site.speed_mps = 1.0;
  ASSERT_TRUE(run([&] { return site.drives(); }));
  EXPECT_EQ(site.state->hold(), HoldReason::HOLD_NONE);
  EXPECT_EQ(site.state->command_plan_id(), 77u);
  EXPECT_EQ(site.state->command_by().source_id().to_string(), "local-planner-agv-1");
  EXPECT_GT(site.truth->velocity_x_mps(), 0.3);

  site.speed_mps.reset();
  ASSERT_TRUE(run([&] {
    return site.state->hold() == HoldReason::HOLD_LATE_COMMAND && site.state->twist().linear_mps() == 0.0 &&
           site.truth->velocity_x_mps() == 0.0;
  }));
  EXPECT_NEAR(site.state->base_in_map().x_m(), site.truth->base_in_map().x_m(), 1e-6) << "no noise was asked for";
}

TEST(FakeVehicleService, ANewerEpochDrivesTheOldOneIsRefused) {
  Site site(kDomain + 1);
  VehicleProcess vehicle(kDomain + 1, 5, standing_at(3, 5));
  const auto run = [&](const std::function<bool()>& done) { return run_until({&site.bus, &vehicle.bus}, done); };
  site.epoch = 3;
  site.speed_mps = 0.2;
  ASSERT_TRUE(run([&] { return site.state && site.state->accepted_epoch() == 3; }));
  site.epoch = 2;
  ASSERT_TRUE(
      run([&] { return site.state->refused_commands() > 3 && site.state->hold() == HoldReason::HOLD_LATE_COMMAND; }));
  EXPECT_EQ(site.state->command_by().epoch(), 3u);
  EXPECT_GT(vehicle.health.counters["refused_old_epoch"], 3u);
}

TEST(FakeVehicleService, CountsItsOwnMalformedCommandsAsRefused) {
  Site site(kDomain + 13);
  VehicleProcess vehicle(kDomain + 13, 5, standing_at(3, 5));
  const auto run = [&](const std::function<bool()>& done) { return run_until({&site.bus, &vehicle.bus}, done); };
  site.speed_mps = 0.2;
  ASSERT_TRUE(run([&] { return site.state && site.state->accepted_epoch() == 1; }));
  site.command_malformed("agv-2");
  site.command_malformed("agv-1");
  ASSERT_TRUE(run([&] { return site.state->refused_commands() > 0; }));
  EXPECT_EQ(site.state->refused_commands(), 1u);
  EXPECT_EQ(vehicle.health.counters["refused_malformed"], 1u);
}

TEST(FakeVehicleService, SeesAPersonAndStopsAtThem) {
  Site site(kDomain + 2);
  VehicleProcess vehicle(kDomain + 2, 5, standing_at(3, 5));
  const auto run = [&](const std::function<bool()>& done) { return run_until({&site.bus, &vehicle.bus}, done); };
  ASSERT_TRUE(run([&] { return site.scan.has_value(); }));
  EXPECT_GE(site.scan->ranges_m()[0], 10.0f);
  ASSERT_TRUE(run([&] {
    site.show_person(4.5, 5);
    return site.scan->ranges_m()[0] < 1.5f;
  }));
  site.speed_mps = 0.8;
  ASSERT_TRUE(
      run([&] { return site.state->hold() == HoldReason::HOLD_CONTACT && site.truth->velocity_x_mps() == 0.0; }));
  EXPECT_NEAR(site.truth->base_in_map().x_m(), 4.5 - 0.25 - 0.35, 0.02);
}

TEST(FakeVehicleService, TheBodyStaysWhereItWasOverARestart) {
  const Folder folder("vehicle-memory");
  ServiceConfig config = standing_at(3, 5);
  config.state_file = folder.path() / "agv-1.state";
  Site site(kDomain + 3);
  double stopped_at = 0.0;
  {
    VehicleProcess vehicle(kDomain + 3, 5, config);
    const auto run = [&](const std::function<bool()>& done) { return run_until({&site.bus, &vehicle.bus}, done); };
    site.epoch = 4;
    site.speed_mps = 1.0;
    ASSERT_TRUE(run([&] { return site.drives() && site.truth->base_in_map().x_m() > 3.5; }));
    stopped_at = site.truth->base_in_map().x_m();
  }
  site.speed_mps.reset();
  site.state.reset();
  VehicleProcess again(kDomain + 3, 6, config);
  ASSERT_TRUE(run_until({&site.bus, &again.bus}, [&] { return site.state && site.state->by().boot_id() == 6; }));
  EXPECT_NEAR(site.truth->base_in_map().x_m(), stopped_at, 0.15);
  EXPECT_EQ(site.state->accepted_epoch(), 4u);
  EXPECT_EQ(site.state->hold(), HoldReason::HOLD_NO_COMMAND);
}

TEST(FakeVehicleService, TheNewcomerOfTwoStaysSilentAndSaysWhy) {
  Site site(kDomain + 4);
  VehicleProcess first(kDomain + 4, 5, standing_at(3, 5));
  ASSERT_TRUE(run_until({&site.bus, &first.bus}, [&] { return site.state.has_value(); }));
  VehicleProcess newcomer(kDomain + 4, 6, standing_at(12, 5));
  const auto run = [&](const std::function<bool()>& done) {
    return run_until({&site.bus, &first.bus, &newcomer.bus}, done);
  };
  ASSERT_TRUE(run([&] { return newcomer.health.last_error.find("duplicate id") != std::string::npos; }));
  EXPECT_EQ(newcomer.health.state, fleet::ServiceState::kDegraded);
  const auto more_of_the_first = [&](int states) {
    const int before = site.states_of_boot[5];
    return run([&] { return site.states_of_boot[5] > before + states; });
  };
  ASSERT_TRUE(more_of_the_first(10)) << "what the newcomer said before it had discovered the first is delivered by now";
  const int by_newcomer = site.states_of_boot[6];
  ASSERT_TRUE(more_of_the_first(40));
  EXPECT_EQ(site.states_of_boot[6], by_newcomer);
  EXPECT_EQ(site.state->by().boot_id(), 5u);
  EXPECT_LT(site.truth->base_in_map().x_m(), 4.0);
}

}  // namespace
}  // namespace aisle::fake_vehicle
