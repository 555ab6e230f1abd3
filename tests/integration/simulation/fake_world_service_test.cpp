#include "services/fake-world/fake_world_service.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "common/wire/geometry.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/vehicle.hpp"
#include "tests/integration/simulation/site.hpp"

namespace aisle::fake_world {
namespace {

using namespace std::chrono_literals;
using simulation_test::Folder;
using simulation_test::run_until;
using simulation_test::site;

constexpr int kDomain = 116;

scenario::Scenario yard() {
  scenario::Scenario scenario;
  scenario.name = "yard";
  scenario::Vehicle vehicle;
  vehicle.id = "agv-1";
  scenario.vehicles.push_back(vehicle);
  scenario::Mover mover;
  mover.id = "walker";
  mover.waypoints_in_map = {{0, 0}, {30, 0}};
  scenario.movers.push_back(mover);
  scenario::Block block;
  block.id = "box";
  block.center_in_map = {5, 5, 0};
  scenario.blocks.push_back(block);
  return scenario;
}

struct WorldProcess {
  WorldProcess(int domain, std::uint64_t boot_id, const ServiceConfig& config)
      : bus(site(domain, "world")),
        shell(bus, {"fake-world", "fake-world", "", boot_id, "", 0}),
        service(shell, config) {}
  bus::DdsBus bus;
  service::Shell shell;
  service::Health& health{shell.health()};
  FakeWorldService service;
};

class Watcher {
 public:
  explicit Watcher(int domain) : bus(site(domain, "watcher")), vehicles_(bus.writer<topics::WorldObstacle>()) {
    bus.on<topics::WorldObstacle>([this](const aisle::WorldObstacle& sample, const bus::SampleInfo& info) {
      const std::string id = sample.obstacle_id().to_string();
      if (info.kind == bus::SampleKind::kDisposed) gone.insert(id);
      if (info.kind == bus::SampleKind::kData) x_of[id] = sample.base_in_map().x_m();
    });
    bus.every(50ms, [this] {
      if (shows_vehicle) show_vehicle();
    });
  }
  void show_vehicle() {
    fleet::Obstacle vehicle;
    vehicle.id = "agv-1";
    vehicle.kind = fleet::Obstacle::Kind::kVehicle;
    vehicle.base_in_map = {20, 20, 0};
    vehicle.footprint = geometry::disc(0.35);
    aisle::WorldObstacle sample = wire::encode(vehicle);
    sample.by(wire::encode(fleet::Origin{"fake-vehicle-agv-1", 1, 1, 1, 0}));
    vehicles_.write(sample);
  }
  bus::DdsBus bus;
  bool shows_vehicle{false};
  std::map<std::string, double> x_of;
  std::set<std::string> gone;

 private:
  bus::Writer<topics::WorldObstacle> vehicles_;
};

TEST(FakeWorldService, BeginsWhenTheVehiclesAreThere) {
  Watcher watcher(kDomain);
  WorldProcess world(kDomain, 5, {yard(), 1, std::nullopt, {}});
  const auto run = [&](const std::function<bool()>& done) { return run_until({&watcher.bus, &world.bus}, done); };
  ASSERT_TRUE(run([&] { return world.health.waits_for == "vehicles agv-1"; }));
  EXPECT_TRUE(watcher.x_of.empty());
  watcher.shows_vehicle = true;
  ASSERT_TRUE(run([&] { return watcher.x_of.count("walker") > 0 && watcher.x_of.count("box") > 0; }));
  const double begin = watcher.x_of["walker"];
  ASSERT_TRUE(run([&] { return watcher.x_of["walker"] > begin + 1.0; }));
  ASSERT_TRUE(run([&] { return world.health.state == fleet::ServiceState::kReady; }));
}

TEST(FakeWorldService, IsNotReadyWhenNothingCanStartIt) {
  scenario::Scenario empty = yard();
  empty.vehicles.clear();
  WorldProcess world(kDomain + 6, 5, {empty, 1, std::nullopt, {}});
  ASSERT_TRUE(run_until({&world.bus}, [&] { return world.health.state == fleet::ServiceState::kWaiting; }));
  EXPECT_EQ(world.health.waits_for, "vehicles");
}

TEST(FakeWorldService, NothingJumpsOverARestart) {
  const Folder folder("world-memory");
  const ServiceConfig config{yard(), 1, std::nullopt, folder.path() / "world.state"};
  Watcher watcher(kDomain + 1);
  watcher.shows_vehicle = true;
  double last = 0.0;
  {
    WorldProcess world(kDomain + 1, 5, config);
    ASSERT_TRUE(run_until(
        {&watcher.bus, &world.bus}, [&] { return watcher.x_of.count("walker") > 0 && watcher.x_of["walker"] > 10.0; },
        20s));
    last = watcher.x_of["walker"];
  }
  watcher.x_of.clear();
  WorldProcess again(kDomain + 1, 6, config);
  ASSERT_TRUE(run_until({&watcher.bus, &again.bus}, [&] { return watcher.x_of.count("walker") > 0; }));
  EXPECT_NEAR(watcher.x_of["walker"], last, 0.5);
}

}  // namespace
}  // namespace aisle::fake_world
