// The service on a bus of its own domain.
#include "services/global-planner/global_planner_service.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "common/wire/traffic.hpp"
#include "tests/integration/global-planner/site.hpp"

namespace aisle::global_planner {
namespace {

/// One planner process.
struct PlannerProcess {
  PlannerProcess(int domain, const std::string& name, std::uint64_t boot_id, bool standby = false)
      : bus(site(domain, name)),
        shell(bus, {"global-planner", name, "", boot_id, "", 0}),
        service(shell, config(standby)) {}
  static ServiceConfig config(bool standby) {
    ServiceConfig config;
    config.standby = standby;
    return config;
  }
  bus::DdsBus bus;
  service::Shell shell;
  service::Health& health{shell.health()};
  GlobalPlannerService service;
};

TEST(GlobalPlannerService, PlansKeepsAndReplaces) {
  PlannerProcess planner(140, "global-planner", 1);
  Site site(140);
  const auto until_plans = [&](std::size_t count) {
    return bus_test::run_until({&planner.bus, &site.bus}, [&] { return site.plans.size() >= count; });
  };
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", 19.0, 5.0);
  ASSERT_TRUE(until_plans(1));
  EXPECT_EQ(site.plans[0].outcome(), aisle::PlanOutcome::PLAN_FOUND);
  EXPECT_EQ(site.plans[0].goal_id().to_string(), "goal-1");
  EXPECT_EQ(site.plans[0].planner().to_string(), "direct");
  EXPECT_EQ(site.plans[0].map_revision(), 1U);
  EXPECT_EQ(site.plans[0].by().source_id().to_string(), "global-planner");
  EXPECT_EQ(site.plans[0].by().epoch(), 1U);
  EXPECT_TRUE(site.is_drivable_now(site.plans[0]));

  site.block(10, 10, 20, 20);  // beside the way
  site.publish_map();
  ASSERT_TRUE(until_plans(2));
  EXPECT_EQ(site.plans[1].plan_id(), site.plans[0].plan_id());
  EXPECT_EQ(site.plans[1].map_revision(), 2U);

  site.block(100, 40, 101, 60);  // the door that it goes through
  site.publish_map();
  ASSERT_TRUE(until_plans(3));
  EXPECT_EQ(site.plans[2].trigger(), aisle::PlanTrigger::TRIGGER_MAP_CHANGED);
  EXPECT_EQ(site.plans[2].map_revision(), 3U);
  EXPECT_GT(site.plans[2].by().sequence_number(), site.plans[1].by().sequence_number());
  EXPECT_TRUE(site.is_drivable_now(site.plans[2]));

  site.send_goal("agv-1", "goal-2", 10.05, 2.0);
  ASSERT_TRUE(until_plans(4));
  EXPECT_EQ(site.plans[3].outcome(), aisle::PlanOutcome::PLAN_GOAL_BLOCKED);
  EXPECT_NE(site.plans[3].detail().to_string().find("(10.05, 2.00)"), std::string::npos)
      << site.plans[3].detail().to_string();
}

TEST(GlobalPlannerService, DropsAndCountsAGoalThatIsNoNumber) {
  PlannerProcess planner(141, "global-planner", 1);
  Site site(141);
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", std::numeric_limits<double>::quiet_NaN(), 5.0);
  ASSERT_TRUE(bus_test::run_until({&planner.bus, &site.bus},
                                  [&] { return planner.health.counters.count("dropped_goal") > 0; }));
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
  EXPECT_TRUE(bus_test::run_until({&planner.bus, &site.bus}, [&] { return site.plans.size() == 5; }))
      << site.plans.size();
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
  const auto of_standby = [&] {
    return std::find_if(site.plans.begin(), site.plans.end(), [](const aisle::Plan& plan) {
      return plan.by().source_id().to_string() == "global-planner-2";
    });
  };
  EXPECT_TRUE(of_standby() == site.plans.end()) << "the standby must not plan while the leader lives";

  primary.reset();
  ASSERT_TRUE(bus_test::run_until({&standby.bus, &site.bus}, [&] { return of_standby() != site.plans.end(); }));
  EXPECT_EQ(of_standby()->by().epoch(), before.by().epoch() + 1);
  EXPECT_EQ(of_standby()->trigger(), aisle::PlanTrigger::TRIGGER_TAKEOVER);
  EXPECT_EQ(of_standby()->waypoints_in_map(), before.waypoints_in_map());
}

/// agv-2 said where it stands before the planner began, and nothing since.
TEST(GlobalPlannerService, TakesThePersonsWordThatASilentVehicleDrivesNoMore) {
  Site site(149);
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.add_vehicle("agv-2", {1.0, 1.0, 0.0});
  site.fall_silent("agv-2");
  site.send_goal("agv-1", "goal-1", 19.0, 5.0);
  PlannerProcess planner(149, "global-planner", 1);
  const auto has = [](const auto& vehicles, const std::string& id) {
    return std::any_of(vehicles.begin(), vehicles.end(),
                       [&](const aisle::SilentVehicle& vehicle) { return vehicle.agv_id().to_string() == id; });
  };
  const auto runs_until = [&](const auto& done) { return bus_test::run_until({&planner.bus, &site.bus}, done); };
  ASSERT_TRUE(runs_until([&] { return has(site.traffic.silent(), "agv-2"); }));
  ASSERT_TRUE(runs_until([&] { return site.grants.count("agv-1") > 0; }));
  EXPECT_EQ(site.grants.at("agv-1").limit_m(), 0.0);

  bus::Writer<topics::SignOff> writer = site.bus.writer<topics::SignOff>();
  ASSERT_TRUE(runs_until([&] { return writer.matched_readers() > 0; }));
  aisle::SignOff word = wire::encode(fleet::SignOff{"agv-2", geometry::Point2{1.0, 1.5}});
  word.by(service::OriginStamper(site.bus, "anybody", 1).next());
  writer.write(word);
  ASSERT_TRUE(runs_until([&] { return planner.health.counters["refused_sign_offs"] > 0; }));
  EXPECT_TRUE(has(site.traffic.silent(), "agv-2"));

  word.by(service::OriginStamper(site.bus, "aisle", 2).next());
  writer.write(word);
  ASSERT_TRUE(runs_until([&] { return has(site.traffic.signed_off(), "agv-2"); }));
  EXPECT_EQ(site.traffic.signed_off()[0].place_in_map().y_m(), 1.5);
  EXPECT_TRUE(runs_until([&] { return site.grants.at("agv-1").limit_m() > 0.0; }));
}

TEST(GlobalPlannerService, BeginsAboveTheEpochThatVehiclesFollowedBeforeAllPlannersWereGone) {
  Site site(147);
  site.publish_map();
  site.add_vehicle("agv-1", {1.0, 5.0, 0.0});
  site.send_goal("agv-1", "goal-1", 19.0, 5.0);
  site.say_followed(7);
  PlannerProcess planner(147, "global-planner", 20);
  // Heard before it leads or a little later: then it raises its epoch.
  ASSERT_TRUE(bus_test::run_until({&planner.bus, &site.bus},
                                  [&] { return !site.plans.empty() && site.plans.back().by().epoch() == 8; }));
  EXPECT_EQ(site.plans.back().goal_id().to_string(), "goal-1");
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
  ASSERT_TRUE(bus_test::run_until({&primary.bus, &standby.bus, &site.bus},
                                  [&] { return primary.health.counters["leads"] == 0; }));
  site.send_goal("agv-1", "goal-2", 15.0, 5.0);
  const auto answered = [&] { return site.plans.back().goal_id().to_string() == "goal-2"; };
  ASSERT_TRUE(bus_test::run_until({&primary.bus, &standby.bus, &site.bus}, answered));
  EXPECT_EQ(site.plans.back().by().source_id().to_string(), "global-planner-2");
}

}  // namespace
}  // namespace aisle::global_planner
