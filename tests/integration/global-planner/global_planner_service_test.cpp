// The service on a bus of its own domain; the test plays the map, the vehicles and the dispatcher.
#include "services/global-planner/global_planner_service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"
#include "services/global-planner/codec.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::global_planner {
namespace {

using namespace std::chrono_literals;
using bus::Bus;
using bus::SampleInfo;
using bus::SampleKind;

constexpr double kRadius_m = 0.3;

bus::Settings site(int domain, const std::string& name) {
  bus::Settings settings = bus_test::loopback(domain, name);
  settings.partition = "planner-test-" + std::to_string(getpid());   // beside the same test in another process
  return settings;
}

/// One planner process.
struct PlannerProcess {
  PlannerProcess(int domain, const std::string& name, std::uint64_t boot_id, bool standby = false)
      : bus(site(domain, name)), service(bus, name, boot_id, health, config(standby)) {}
  static ServiceConfig config(bool standby) {
    ServiceConfig config;
    config.standby = standby;
    return config;
  }
  Bus bus;
  service::Health health;
  GlobalPlannerService service;
};

/// Everything else of a site: a hall of 20 x 10 m with two doors, and vehicles that say every 50 ms where they stand.
class Site {
 public:
  explicit Site(int domain)
      : bus(site(domain, "site")),
        grid(grid::Geometry{200, 100, 0.1, {}}),
        infos_(bus.writer<topics::MapInfo>()),
        tiles_(bus.writer<topics::MapTile>()),
        vehicles_(bus.writer<topics::VehicleInfo>()),
        states_(bus.writer<topics::VehicleState>()),
        goals_(bus.writer<topics::Goal>()) {
    block(100, 0, 101, 99);
    block(100, 40, 101, 60, grid::Occupancy::kFree);
    block(100, 80, 101, 97, grid::Occupancy::kFree);
    bus.on<topics::Plan>([this](const aisle::Plan& sample, const SampleInfo& info) {
      if (info.kind != SampleKind::kData) return;
      plans.push_back(sample);
    });
    bus.every(50ms, [this] { publish_states(); });
  }

  void block(int x0, int y0, int x1, int y1, grid::Occupancy fill = grid::Occupancy::kOccupied) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) grid.set({x, y}, fill);
    }
  }

  void publish_map() {
    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = ++revision;
    summary.tiling = {64, grid.geometry()};
    for (int i = 0; i < summary.tiling.count(); ++i) {
      grid::Tile tile;
      tile.map_id = "hall";
      tile.tile_x = i % summary.tiling.tiles_x();
      tile.tile_y = i / summary.tiling.tiles_x();
      tile.revision = revision;
      tile.cells = grid::tile_cells(grid, summary.tiling, i);
      tile.hash = grid::tile_hash(tile.cells);
      summary.tile_hashes.push_back(tile.hash);
      tiles_.write(wire::encode(tile));
    }
    summary.hash = grid::map_hash(summary.tile_hashes);
    aisle::MapInfo sample = wire::encode(summary);
    stamp(sample.by());
    infos_.write(sample);
  }

  void add_vehicle(const std::string& id, const geometry::Pose2& pose) {
    aisle::VehicleInfo info;
    info.agv_id(id);
    stamp(info.by());
    info.radius_m(kRadius_m);
    vehicles_.write(info);
    poses_[id] = pose;
    publish_states();
  }

  void send_goal(const std::string& agv, const std::string& id, double x, double y) {
    aisle::Goal goal;
    goal.agv_id(agv);
    goal.goal_id(id);
    stamp(goal.by());
    goal.pose_in_map(wire::encode(geometry::Pose2{x, y, 0.0}));
    goal.position_tolerance_m(0.1);
    goals_.write(goal);
  }

  bool is_drivable_now(const aisle::Plan& sample) const {
    const auto plan = decode(sample);
    if (!plan || plan->waypoints_in_map.empty()) return false;
    const grid::ClearanceField clearance(grid, 2.0);
    return is_drivable({clearance, plan->waypoints_in_map.front(), plan->waypoints_in_map.back(), kRadius_m}, plan->waypoints_in_map);
  }

  Bus bus;
  grid::OccupancyGrid grid;
  std::uint64_t revision{0};
  std::vector<aisle::Plan> plans;

 private:
  void stamp(aisle::Origin& by) { by = origin_.next(); }
  void publish_states() {
    for (const auto& [id, pose] : poses_) {
      aisle::VehicleState state;
      state.agv_id(id);
      stamp(state.by());
      state.base_in_map(wire::encode(pose));
      states_.write(state);
    }
  }

  service::OriginStamper origin_{"site", 1};
  bus::Writer<topics::MapInfo> infos_;
  bus::Writer<topics::MapTile> tiles_;
  bus::Writer<topics::VehicleInfo> vehicles_;
  bus::Writer<topics::VehicleState> states_;
  bus::Writer<topics::Goal> goals_;
  std::map<std::string, geometry::Pose2> poses_;
};

TEST(GlobalPlannerService, PlansKeepsAndReplaces) {
  PlannerProcess planner(140, "global-planner", 1);
  Site site(140);
  const auto until_plans = [&](std::size_t count) { return bus_test::run_until({&planner.bus, &site.bus}, [&] { return site.plans.size() >= count; }); };
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", 19.0, 5.0);
  ASSERT_TRUE(until_plans(1));
  EXPECT_EQ(site.plans[0].outcome(), PlanOutcome::PLAN_FOUND);
  EXPECT_EQ(site.plans[0].goal_id().to_string(), "goal-1");
  EXPECT_EQ(site.plans[0].planner().to_string(), "wang");
  EXPECT_EQ(site.plans[0].map_revision(), 1U);
  EXPECT_EQ(site.plans[0].by().source_id().to_string(), "global-planner");
  EXPECT_EQ(site.plans[0].by().epoch(), 1U);
  EXPECT_TRUE(site.is_drivable_now(site.plans[0]));

  site.block(10, 10, 20, 20);   // beside the way
  site.publish_map();
  ASSERT_TRUE(until_plans(2));
  EXPECT_EQ(site.plans[1].plan_id(), site.plans[0].plan_id());
  EXPECT_EQ(site.plans[1].map_revision(), 2U);

  site.block(100, 40, 101, 60);   // the door that it goes through
  site.publish_map();
  ASSERT_TRUE(until_plans(3));
  EXPECT_EQ(site.plans[2].trigger(), PlanTrigger::TRIGGER_MAP_CHANGED);
  EXPECT_EQ(site.plans[2].map_revision(), 3U);
  EXPECT_GT(site.plans[2].by().sequence_number(), site.plans[1].by().sequence_number());
  EXPECT_TRUE(site.is_drivable_now(site.plans[2]));

  site.send_goal("agv-1", "goal-2", 10.05, 2.0);
  ASSERT_TRUE(until_plans(4));
  EXPECT_EQ(site.plans[3].outcome(), PlanOutcome::PLAN_GOAL_BLOCKED);
  EXPECT_NE(site.plans[3].detail().to_string().find("(10.05, 2.00)"), std::string::npos) << site.plans[3].detail().to_string();
}

TEST(GlobalPlannerService, DropsAndCountsAGoalThatIsNoNumber) {
  PlannerProcess planner(141, "global-planner", 1);
  Site site(141);
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", std::numeric_limits<double>::quiet_NaN(), 5.0);
  ASSERT_TRUE(bus_test::run_until({&planner.bus, &site.bus}, [&] { return planner.health.counters.count("dropped_goal") > 0; }));
  site.send_goal("agv-1", "goal-2", 19.0, 5.0);
  ASSERT_TRUE(bus_test::run_until({&planner.bus, &site.bus}, [&] { return !site.plans.empty(); }));
  EXPECT_EQ(site.plans[0].goal_id().to_string(), "goal-2");
}

TEST(GlobalPlannerService, PlansForALateComerToo) {
  Site site(142);
  site.publish_map();
  for (int i = 0; i < 5; ++i) {
    site.add_vehicle("agv-" + std::to_string(i), {1.0, 1.0 + i, 0.0});
    site.send_goal("agv-" + std::to_string(i), "goal", 18.0, 1.0 + i);
  }
  PlannerProcess planner(142, "global-planner", 1);
  EXPECT_TRUE(bus_test::run_until({&planner.bus, &site.bus}, [&] { return site.plans.size() == 5; })) << site.plans.size();
}

TEST(GlobalPlannerService, IsFollowedByItsStandbyWithTheNextEpoch) {
  Site site(143);
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", 19.0, 5.0);
  auto primary = std::make_unique<PlannerProcess>(143, "global-planner", 1);
  PlannerProcess standby(143, "global-planner-2", 2, true);
  ASSERT_TRUE(bus_test::run_until({&primary->bus, &standby.bus, &site.bus}, [&] { return !site.plans.empty(); }));
  const aisle::Plan before = site.plans[0];
  EXPECT_EQ(before.by().source_id().to_string(), "global-planner");

  const auto is_heard = [&] { return standby.health.counters["heard_plans"] > 0; };
  ASSERT_TRUE(bus_test::run_until({&primary->bus, &standby.bus, &site.bus}, is_heard));
  ASSERT_EQ(site.plans.size(), 1U) << "the standby must not plan while the leader lives";
  primary.reset();
  ASSERT_TRUE(bus_test::run_until({&standby.bus, &site.bus}, [&] { return site.plans.size() >= 2; }));
  EXPECT_EQ(site.plans[1].by().source_id().to_string(), "global-planner-2");
  EXPECT_EQ(site.plans[1].by().epoch(), before.by().epoch() + 1);
  EXPECT_EQ(site.plans[1].trigger(), PlanTrigger::TRIGGER_TAKEOVER);
  EXPECT_EQ(site.plans[1].waypoints_in_map(), before.waypoints_in_map());
}

TEST(GlobalPlannerService, GivesWayWhenItComesBackAfterATakeover) {
  Site site(144);
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", 19.0, 5.0);
  PlannerProcess primary(144, "global-planner", 1);
  PlannerProcess standby(144, "global-planner-2", 2, true);
  ASSERT_TRUE(bus_test::run_until({&primary.bus, &standby.bus, &site.bus}, [&] { return !site.plans.empty(); }));
  const auto heard = [&] { return standby.health.counters["leads"] == 1; };
  ASSERT_TRUE(bus_test::run_until({&standby.bus, &site.bus}, heard)) << "the primary hangs: its loop does not run";
  ASSERT_TRUE(bus_test::run_until({&primary.bus, &standby.bus, &site.bus}, [&] { return primary.health.counters["leads"] == 0; }));
  site.send_goal("agv-1", "goal-2", 15.0, 5.0);
  const auto answered = [&] { return site.plans.back().goal_id().to_string() == "goal-2"; };
  ASSERT_TRUE(bus_test::run_until({&primary.bus, &standby.bus, &site.bus}, answered));
  EXPECT_EQ(site.plans.back().by().source_id().to_string(), "global-planner-2");
}

}  // namespace
}  // namespace aisle::global_planner
