// The service on a bus of its own domain; the test plays the map, the vehicle, the tracker and the global planner.
#include "services/local-planner/local_planner_service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/grid/tiles.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/traffic.hpp"
#include "common/wire/vehicle.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::local_planner {
namespace {

using namespace std::chrono_literals;
using bus::SampleInfo;
using bus::SampleKind;

bus::Settings site(int domain, const std::string& name) {
  bus::Settings settings = bus_test::loopback(domain, name);
  settings.partition = "local-planner-test-" + std::to_string(getpid());
  return settings;
}

struct PlannerProcess {
  PlannerProcess(int domain, std::uint64_t boot_id)
      : bus(site(domain, "local-planner")),
        shell(bus, {"local-planner", "local-planner-agv-1", "agv-1", boot_id, "", 0}),
        service(shell, {}) {}
  bus::DdsBus bus;
  service::Shell shell;
  service::Health& health{shell.health()};
  LocalPlannerService service;
};

/// A hall of 20 x 10 m and an obedient vehicle in it.
class Site {
 public:
  explicit Site(int domain, const std::string& agv_id = "agv-1")
      : bus(site(domain, "site")),
        agv_id_(agv_id),
        infos_(bus.writer<topics::MapInfo>()),
        tiles_(bus.writer<topics::MapTile>()),
        zones_(bus.writer<topics::MapZones>()),
        vehicles_(bus.writer<topics::VehicleInfo>()),
        states_(bus.writer<topics::VehicleState>()),
        plans_(bus.writer<topics::Plan>()),
        tracking_(bus.writer<topics::TrackingStatus>()),
        traffic_(bus.writer<topics::TrafficStatus>()) {
    bus.on<topics::VelocityCommand>([this](const aisle::VelocityCommand& sample, const SampleInfo& info) {
      if (info.kind != SampleKind::kData || sample.agv_id().to_string() != agv_id_) return;
      commands.push_back(sample);
      accepted_epoch = std::max(accepted_epoch, sample.by().epoch());
      if (sample.by().epoch() == accepted_epoch)
        wanted = {sample.twist().linear_mps(), sample.twist().angular_radps(), 0.0};
    });
    bus.on<topics::NavigationStatus>([this](const aisle::NavigationStatus& sample, const SampleInfo& info) {
      if (info.kind == SampleKind::kData && sample.agv_id().to_string() == agv_id_) statuses.push_back(sample);
    });
    bus.every(20ms, [this] { move(); });
  }

  void publish_map() {
    const grid::OccupancyGrid grid(grid::Geometry{200, 100, 0.1, {}});
    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = 1;
    summary.tiling = {64, grid.geometry()};
    for (int tile = 0; tile < summary.tiling.count(); ++tile) {
      grid::Tile t;
      t.map_id = summary.map_id;
      t.tile_x = tile % summary.tiling.tiles_x();
      t.tile_y = tile / summary.tiling.tiles_x();
      t.revision = 1;
      t.cells = grid::tile_cells(grid, summary.tiling, tile);
      t.hash = grid::tile_hash(t.cells);
      summary.tile_hashes.push_back(t.hash);
      aisle::MapTile sample = wire::encode(t);
      tiles_.write(sample);
    }
    summary.hash = grid::map_hash(summary.tile_hashes);
    aisle::MapInfo sample = wire::encode(summary);
    sample.by(origin(sequence_++));
    infos_.write(sample);

    aisle::MapZones zones = wire::encode(fleet::MapZones{"hall", 1, {}});
    zones.by(origin(sequence_++));
    zones_.write(zones);
  }

  void publish_vehicle() {
    aisle::VehicleInfo info = wire::encode(fleet::Vehicle{agv_id_, geometry::disc(0.35), {}, 10.0, 0.2});
    info.by(origin(1));
    vehicles_.write(info);
    vehicle_lives = true;
  }

  void publish_plan(const std::string& goal_id, double x, double y, std::uint32_t epoch = 1) {
    aisle::Plan plan;
    plan.agv_id(agv_id_);
    plan.by(wire::encode(fleet::Origin{"global-planner", epoch, epoch, sequence_++, 1}));
    plan.plan_id(7);
    plan.goal_id(goal_id);
    plan.map_id("hall");
    plan.map_revision(1);
    plan.outcome(PlanOutcome::PLAN_FOUND);
    plan.goal_in_map(wire::encode(geometry::Pose2{x, y, 0.0}));
    plan.position_tolerance_m(0.15);
    plan.waypoints_in_map().push_back(wire::encode(base.position()));
    plan.waypoints_in_map().push_back(wire::encode(geometry::Point2{x, y}));
    plans_.write(plan);
  }

  /// Of another vehicle.
  void say_peer_stands(const std::string& agv_id, geometry::Point2 place_in_map) {
    aisle::VehicleState state;
    state.agv_id(agv_id);
    state.by(wire::encode(fleet::Origin{"site-of-" + agv_id, 1, 1, sequence_++, 1}));
    state.base_in_map(wire::encode(geometry::Pose2{place_in_map.x, place_in_map.y, 0.0}));
    states_.write(state);
  }

  /// As the planner of publish_plan says it.
  void say_signed_off(const std::string& agv_id, geometry::Point2 place_in_map) {
    fleet::TrafficStatus status;
    status.source_id = "global-planner";
    status.beat = ++beat_;
    status.signed_off.push_back({agv_id, place_in_map});
    aisle::TrafficStatus sample = wire::encode(status);
    sample.by(wire::encode(fleet::Origin{"global-planner", 1, 1, sequence_++, 1}));
    traffic_.write(sample);
  }

  const aisle::NavigationStatus* status() const { return statuses.empty() ? nullptr : &statuses.back(); }
  bool says(NavigationPhase phase, NavigationReason reason) const {
    return status() != nullptr && status()->phase() == phase && status()->reason() == reason;
  }

  bus::DdsBus bus;
  geometry::Pose2 base{3.0, 5.0, 0.0};
  geometry::Twist2 twist, wanted;
  std::uint32_t accepted_epoch{4};  // of a planner of before
  bool vehicle_lives{false};
  bool tracker_lives{true};
  bool lidar_lives{true};
  std::vector<aisle::VelocityCommand> commands;
  std::vector<aisle::NavigationStatus> statuses;

 private:
  aisle::Origin origin(std::uint64_t sequence_number) const {
    return wire::encode(fleet::Origin{"site-of-" + agv_id_, 1, 1, sequence_number, 1});
  }

  void move() {
    if (vehicle_lives) {
      twist = kinematics::limit_change(twist, wanted, {}, 0.02);
      base = kinematics::advance(base, twist, 0.02);
      aisle::VehicleState state;
      state.agv_id(agv_id_);
      state.by(origin(sequence_++));
      state.base_in_map(wire::encode(base));
      state.twist(wire::encode(twist));
      state.accepted_epoch(accepted_epoch);
      states_.write(state);
    }
    if (tracker_lives) {
      aisle::TrackingStatus status;
      status.source_id("tracker-of-" + agv_id_);
      status.by(origin(sequence_++));
      if (lidar_lives) ++scan_;
      aisle::ScanUse use;
      use.agv_id(agv_id_);
      use.scan_sequence(scan_);
      use.scan_stamp_ns(1234);
      status.newest_scans().push_back(use);
      use.agv_id("agv-9");  // its scans come on
      use.scan_sequence(sequence_);
      status.newest_scans().push_back(use);
      tracking_.write(status);
    }
  }

  std::string agv_id_;
  bus::Writer<topics::MapInfo> infos_;
  bus::Writer<topics::MapTile> tiles_;
  bus::Writer<topics::MapZones> zones_;
  bus::Writer<topics::VehicleInfo> vehicles_;
  bus::Writer<topics::VehicleState> states_;
  bus::Writer<topics::Plan> plans_;
  bus::Writer<topics::TrackingStatus> tracking_;
  bus::Writer<topics::TrafficStatus> traffic_;
  std::uint64_t beat_{0};
  std::uint64_t sequence_{1};
  std::uint64_t scan_{1};
};

TEST(LocalPlannerService, DrivesToTheGoalWithTheNextEpochAndTellsWhy) {
  Site site(180);
  PlannerProcess planner(180, 1);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planner.bus, &site.bus}, done, 20s);
  };
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_WAITING, NavigationReason::REASON_NO_STATE); }));
  EXPECT_TRUE(site.commands.empty()) << "no command before the vehicle's epoch is known";
  site.publish_vehicle();
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_WAITING, NavigationReason::REASON_NO_MAP); }));
  site.publish_map();
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_WAITING, NavigationReason::REASON_NO_GOAL); }));
  site.publish_plan("goal-1", 7.0, 5.0);
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_ARRIVED, NavigationReason::REASON_NONE); }));
  EXPECT_LT(geometry::distance(site.base.position(), {7.0, 5.0}), 0.16);

  const aisle::VelocityCommand& command = site.commands.back();
  EXPECT_EQ(command.by().epoch(), 5U);
  EXPECT_EQ(command.goal_id().to_string(), "goal-1");
  EXPECT_EQ(command.plan_id(), 7U);
  EXPECT_EQ(command.map_revision(), 1U);
  EXPECT_EQ(command.scan_stamp_ns(), 1234);
  for (std::size_t i = 1; i < site.commands.size(); ++i)
    EXPECT_GT(site.commands[i].by().sequence_number(), site.commands[i - 1].by().sequence_number());
  EXPECT_EQ(site.status()->goal_id().to_string(), "goal-1");
  EXPECT_EQ(site.status()->plan_id(), 7U);
}

TEST(LocalPlannerService, IsNotReadyBeforeItRan) {
  PlannerProcess planner(188, 1);
  planner.shell.report_now();
  EXPECT_EQ(planner.health.state, fleet::ServiceState::kWaiting);
  EXPECT_EQ(planner.health.waits_for, "its first cycle");
}

TEST(LocalPlannerService, StopsWhenTheTrackerFallsSilent) {
  Site site(181);
  PlannerProcess planner(181, 1);
  site.publish_vehicle();
  site.publish_map();
  site.publish_plan("goal-1", 18.0, 5.0);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planner.bus, &site.bus}, done, 20s);
  };
  ASSERT_TRUE(until([&] { return site.twist.linear_mps > 0.8; }));
  site.tracker_lives = false;
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_HELD, NavigationReason::REASON_STALE_TRACKER); }));
  ASSERT_TRUE(until([&] { return site.twist.linear_mps == 0.0; }));
  site.tracker_lives = true;
  EXPECT_TRUE(until([&] { return site.twist.linear_mps > 0.3; }));
}

TEST(LocalPlannerService, StopsWhenItsOwnLidarFallsSilentWhoeverElseIsSeen) {
  Site site(185);
  PlannerProcess planner(185, 1);
  site.publish_vehicle();
  site.publish_map();
  site.publish_plan("goal-1", 18.0, 5.0);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planner.bus, &site.bus}, done, 20s);
  };
  ASSERT_TRUE(until([&] { return site.twist.linear_mps > 0.8; }));
  site.lidar_lives = false;
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_HELD, NavigationReason::REASON_STALE_TRACKER); }));
  EXPECT_EQ(site.status()->detail().to_string(), "the tracker works, but has no fresh scan of agv-1");
  ASSERT_TRUE(until([&] { return site.twist.linear_mps == 0.0; }));
  site.lidar_lives = true;
  EXPECT_TRUE(until([&] { return site.twist.linear_mps > 0.3; }));
}

TEST(LocalPlannerService, RefusesThePlanOfAPlannerThatWasReplaced) {
  Site site(186);
  PlannerProcess planner(186, 1);
  site.publish_vehicle();
  site.publish_map();
  site.publish_plan("goal-1", 18.0, 5.0, 3);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planner.bus, &site.bus}, done, 20s);
  };
  ASSERT_TRUE(until([&] { return site.twist.linear_mps > 0.3; }));
  site.publish_plan("goal-2", 3.0, 2.0, 2);
  ASSERT_TRUE(until([&] { return planner.health.counters["refused_plan_old_epoch"] == 1; }));
  EXPECT_EQ(planner.health.counters["plan_epoch"], 3U);
  const std::size_t said = site.commands.size();
  ASSERT_TRUE(until([&] { return site.commands.size() > said + 5; }));
  EXPECT_EQ(site.commands.back().goal_id().to_string(), "goal-1");
  site.publish_plan("goal-2", 3.0, 2.0, 4);
  ASSERT_TRUE(until([&] { return site.commands.back().goal_id().to_string() == "goal-2"; }));
}

TEST(LocalPlannerService, DrivesWhereAVehicleWasHeardLastThatAPersonSawElsewhere) {
  Site site(190);
  PlannerProcess planner(190, 1);
  site.publish_vehicle();
  site.publish_map();
  bool peer_speaks = true;
  site.bus.every(50ms, [&] {
    if (peer_speaks) site.say_peer_stands("agv-2", {7.0, 5.0});
  });
  site.publish_plan("goal-1", 7.0, 5.0);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planner.bus, &site.bus}, done, 20s);
  };
  ASSERT_TRUE(
      until([&] { return site.status() != nullptr && site.status()->reason() == NavigationReason::REASON_VEHICLE; }));

  peer_speaks = false;
  planner.bus.every(100ms, [&] { site.say_signed_off("agv-2", {7.0, 8.0}); });
  EXPECT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_ARRIVED, NavigationReason::REASON_NONE); }));
}

TEST(LocalPlannerService, FallsSilentWhenTheVehicleObeysALaterEpoch) {
  Site site(182);
  PlannerProcess planner(182, 1);
  site.publish_vehicle();
  site.publish_map();
  site.publish_plan("goal-1", 18.0, 5.0);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planner.bus, &site.bus}, done, 20s);
  };
  ASSERT_TRUE(until([&] { return site.twist.linear_mps > 0.3; }));
  site.accepted_epoch = 9;
  site.wanted = {};
  ASSERT_TRUE(until([&] { return site.says(NavigationPhase::PHASE_HELD, NavigationReason::REASON_AUTHORITY); }));
  const std::size_t commands = site.commands.size();
  const std::size_t statuses = site.statuses.size();
  int later = 0;
  planner.bus.every(50ms, [&] { ++later; });
  ASSERT_TRUE(until([&] { return later >= 10; }));
  EXPECT_LE(site.commands.size(), commands + 2) << "what was on its way may still come";
  EXPECT_LE(site.statuses.size(), statuses + 1);
}

TEST(LocalPlannerService, ARestartedOneTakesOver) {
  Site site(183);
  auto planner = std::make_unique<PlannerProcess>(183, 1);
  site.publish_vehicle();
  site.publish_map();
  site.publish_plan("goal-1", 18.0, 5.0);
  ASSERT_TRUE(bus_test::run_until(
      {&planner->bus, &site.bus}, [&] { return site.twist.linear_mps > 0.3; }, 20s));
  const std::uint32_t epoch = site.accepted_epoch;
  planner = std::make_unique<PlannerProcess>(183, 2);
  ASSERT_TRUE(bus_test::run_until(
      {&planner->bus, &site.bus}, [&] { return site.accepted_epoch == epoch + 1 && site.twist.linear_mps > 0.3; },
      20s));
}

/// Two vehicles' planners as `aisle-local-planner --agv agv-1,agv-2` has them: two shells on one bus.
struct TwoPlanners {
  explicit TwoPlanners(int domain)
      : bus(site(domain, "local-planner")),
        first_shell(bus, {"local-planner", "local-planner-agv-1", "agv-1", 1, "", 0}),
        second_shell(first_shell, {"local-planner", "local-planner-agv-2", "agv-2", 1, "", 0}),
        first(first_shell, {}),
        second(second_shell, {}) {}
  bus::DdsBus bus;
  service::Shell first_shell, second_shell;
  LocalPlannerService first, second;
};

TEST(LocalPlannerService, OfTwoVehiclesInOneProcessOneGoesOnWhenTheOtherLosesItsAuthority) {
  Site one(187, "agv-1");
  Site two(187, "agv-2");
  two.base = {3.0, 8.5, 0.0};
  TwoPlanners planners(187);
  const auto until = [&](const std::function<bool()>& done) {
    return bus_test::run_until({&planners.bus, &one.bus, &two.bus}, done, 30s);
  };
  one.publish_map();
  one.publish_vehicle();
  two.publish_vehicle();
  one.publish_plan("goal-1", 17.0, 2.0);
  two.publish_plan("goal-2", 17.0, 8.5);
  ASSERT_TRUE(until([&] { return one.twist.linear_mps > 0.3 && two.twist.linear_mps > 0.3; }));
  EXPECT_EQ(one.commands.back().by().source_id().to_string(), "local-planner-agv-1");
  EXPECT_EQ(two.commands.back().by().source_id().to_string(), "local-planner-agv-2");
  EXPECT_EQ(one.commands.back().goal_id().to_string(), "goal-1");
  EXPECT_EQ(two.commands.back().goal_id().to_string(), "goal-2");

  one.accepted_epoch = 9;
  one.wanted = {};
  ASSERT_TRUE(until([&] { return one.says(NavigationPhase::PHASE_HELD, NavigationReason::REASON_AUTHORITY); }));
  EXPECT_NE(planners.first_shell.health().last_error, "");
  EXPECT_EQ(planners.second_shell.health().last_error, "");
  const std::size_t commands = one.commands.size();
  ASSERT_TRUE(until([&] { return two.says(NavigationPhase::PHASE_ARRIVED, NavigationReason::REASON_NONE); }));
  EXPECT_LE(one.commands.size(), commands + 2) << "what was on its way may still come";
  EXPECT_TRUE(until([&] { return planners.first_shell.health().state == fleet::ServiceState::kDegraded; }));
  EXPECT_TRUE(until([&] { return planners.second_shell.health().state == fleet::ServiceState::kReady; }));
}

TEST(LocalPlannerService, DropsAndCountsWhatCannotBeTrue) {
  Site site(184);
  PlannerProcess planner(184, 1);
  site.publish_vehicle();
  site.publish_map();
  site.publish_plan("goal-1", std::nan(""), 5.0);
  ASSERT_TRUE(bus_test::run_until(
      {&planner.bus, &site.bus}, [&] { return planner.health.counters["dropped_plan"] == 1; }, 20s));
  EXPECT_TRUE(bus_test::run_until(
      {&planner.bus, &site.bus},
      [&] { return site.says(NavigationPhase::PHASE_WAITING, NavigationReason::REASON_NO_GOAL); }, 20s));
}

}  // namespace
}  // namespace aisle::local_planner
