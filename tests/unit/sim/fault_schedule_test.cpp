// A fault plan laid out for the processes of a site.
#include "tools/sim/fault_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace aisle::sim {
namespace {

using namespace std::chrono_literals;
using Kind = FaultAction::Kind;
using ::testing::HasSubstr;

const std::vector<std::string> kServices{"map", "local-planner-agv-1", "local-planner-agv-2"};
const std::vector<std::string> kWorld{"fake-vehicle-agv-1"};

TEST(FaultSchedule, WhatIsDoneIsUndoneLaterAndAtTheLatestWhenThePlanStops) {
  FaultPlan plan;
  plan.stop_s = 20.0;
  Crash crash;
  crash.process = "map";
  crash.at_s = 5.0;
  crash.every_s = 10.0;
  crash.restart_after_s = 8.0;
  plan.crashes.push_back(crash);
  const std::vector<FaultAction> actions = schedule(plan, kServices, kWorld, 1);
  ASSERT_EQ(actions.size(), 4u);
  EXPECT_EQ(actions[0].kind, Kind::kCrash);
  EXPECT_EQ(actions[0].t_s, 5.0);
  EXPECT_EQ(actions[1].kind, Kind::kStart);
  EXPECT_EQ(actions[1].t_s, 13.0);
  EXPECT_EQ(actions[2].t_s, 15.0);
  EXPECT_EQ(actions[3].kind, Kind::kStart);
  EXPECT_EQ(actions[3].t_s, 20.0) << "not at 23 s: the plan stops";
}

TEST(FaultSchedule, NothingBeginsAfterThePlanStopped) {
  FaultPlan plan;
  plan.stop_s = 4.0;
  plan.hangs.resize(1);
  plan.hangs[0].at_s = 5.0;
  plan.links.resize(1);
  plan.links[0].begin_s = 5.0;
  EXPECT_TRUE(schedule(plan, kServices, kWorld, 1).empty());
}

TEST(FaultSchedule, APatternDrawsOneServiceEachTimeAndNeverThePartsOfTheWorld) {
  FaultPlan plan;
  plan.stop_s = 1000.0;
  plan.hangs.resize(1);
  plan.hangs[0].every_s = 1.0;
  std::set<std::string> hit;
  for (const FaultAction& action : schedule(plan, kServices, kWorld, 1)) hit.insert(action.process);
  EXPECT_EQ(hit, std::set<std::string>(kServices.begin(), kServices.end()));
}

TEST(FaultSchedule, TheSameSeedDrawsTheSameAndAnotherDoesNot) {
  FaultPlan plan;
  plan.hangs.resize(1);
  plan.hangs[0].every_s = 1.0;
  const auto names = [&](std::uint64_t seed) {
    std::string all;
    for (const FaultAction& action : schedule(plan, kServices, kWorld, seed)) all += action.process + " ";
    return all;
  };
  EXPECT_EQ(names(3), names(3));
  EXPECT_NE(names(3), names(4));
}

TEST(FaultSchedule, EachVehicleIsHeldOnceAPeriodAsLongAsItSays) {
  FaultPlan plan;
  plan.stop_s = 600.0;
  plan.holds.resize(1);
  const std::vector<std::string> world{"fake-vehicle-agv-1", "fake-vehicle-agv-2", "fake-world"};
  std::map<std::string, std::vector<double>> begins;
  std::map<int, double> begun_s;
  for (const FaultAction& action : schedule(plan, kServices, world, 1)) {
    if (action.kind == Kind::kHold) {
      begins[action.process].push_back(action.t_s);
      begun_s[action.fault] = action.t_s;
    } else {
      ASSERT_EQ(action.kind, Kind::kLetGo);
      const double for_s = action.t_s - begun_s.at(action.fault);
      EXPECT_TRUE((for_s >= 2.0 - 1e-9 && for_s <= 8.0) || action.t_s == 600.0) << for_s;
    }
  }
  ASSERT_EQ(begins.size(), 2u) << "the vehicles, and nothing else";
  for (const auto& [vehicle, times_s] : begins) {
    ASSERT_EQ(times_s.size(), 10u) << vehicle;
    for (std::size_t i = 0; i < times_s.size(); ++i) EXPECT_EQ(static_cast<std::size_t>(times_s[i] / 60.0), i);
  }
  EXPECT_NE(begins["fake-vehicle-agv-1"], begins["fake-vehicle-agv-2"]);
}

TEST(FaultSchedule, TheVehiclesThatAreNamedAreSlow) {
  FaultPlan plan;
  plan.slows.resize(1);
  plan.slows[0].vehicle = "agv-*";
  plan.slows[0].begin_s = 3.0;
  plan.slows[0].for_s = 4.0;
  const std::vector<FaultAction> actions = schedule(plan, kServices, kWorld, 1);
  ASSERT_EQ(actions.size(), 2u);
  EXPECT_EQ(actions[0].kind, Kind::kSlow);
  EXPECT_EQ(actions[0].process, "fake-vehicle-agv-1");
  EXPECT_EQ(actions[0].share, 0.8);
  EXPECT_EQ(actions[1].kind, Kind::kFast);
  EXPECT_EQ(actions[1].t_s, 7.0);

  plan.slows[0].vehicle = "agv-7";
  EXPECT_THROW(schedule(plan, kServices, kWorld, 1), config::BadInput);
}

TEST(FaultSchedule, EachDeathTakesAVehicleThatStillLivesAndItIsSignedOffLater) {
  FaultPlan plan;
  plan.stop_s = 100.0;
  plan.deaths.resize(1);
  plan.deaths[0].at_s = 3.0;
  plan.deaths[0].every_s = 10.0;
  const std::vector<std::string> world{"fake-vehicle-agv-1", "fake-vehicle-agv-2", "fake-world"};
  std::map<int, FaultAction> deaths, sign_offs;

  for (const FaultAction& action : schedule(plan, kServices, world, 1))
    (action.kind == Kind::kDeath ? deaths : sign_offs)[action.fault] = action;

  ASSERT_EQ(deaths.size(), 2u) << "then none is left";
  ASSERT_EQ(sign_offs.size(), 2u);
  EXPECT_NE(deaths.begin()->second.process, deaths.rbegin()->second.process);
  for (const auto& [fault, death] : deaths) {
    ASSERT_EQ(sign_offs.count(fault), 1u);
    EXPECT_EQ(sign_offs[fault].kind, Kind::kSignOff);
    EXPECT_EQ(sign_offs[fault].process, death.process);
    EXPECT_EQ(sign_offs[fault].t_s, death.t_s + 60.0);
  }
}

TEST(FaultSchedule, APartOfTheWorldIsHitWhereItIsNamedInFull) {
  FaultPlan plan;
  plan.crashes.resize(1);
  plan.crashes[0].process = "fake-vehicle-agv-1";
  EXPECT_EQ(schedule(plan, kServices, kWorld, 1).front().process, "fake-vehicle-agv-1");
}

TEST(FaultSchedule, ACutJoinsTwoDifferentProcesses) {
  FaultPlan plan;
  plan.stop_s = 1000.0;
  plan.cuts.resize(1);
  plan.cuts[0].every_s = 1.0;
  for (const FaultAction& action : schedule(plan, kServices, kWorld, 1)) EXPECT_NE(action.process, action.to);
}

TEST(FaultSchedule, TheEndOfACutMayBeAPatternOfTheWorldsProcesses) {
  FaultPlan plan;
  plan.cuts.resize(1);
  plan.cuts[0].from = "fake-vehicle-*";
  plan.cuts[0].to = "map";
  EXPECT_EQ(schedule(plan, kServices, kWorld, 1).front().process, "fake-vehicle-agv-1");
  plan.crashes.resize(1);
  plan.crashes[0].process = "fake-vehicle-*";
  EXPECT_THROW(schedule(plan, kServices, kWorld, 1), config::BadInput) << "a crash must name it in full";
}

TEST(FaultSchedule, ANameThatFitsNobodyIsRefusedWithTheNearest) {
  FaultPlan plan;
  plan.crashes.resize(1);
  plan.crashes[0].process = "mapp";
  try {
    schedule(plan, kServices, kWorld, 1);
    FAIL() << "was taken";
  } catch (const config::BadInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("did you mean 'map'"));
  }
}

TEST(FaultSchedule, ALinkThatFitsNobodyIsRefusedWithTheNearest) {
  for (const auto end : {&LinkFault::from, &LinkFault::to}) {
    FaultPlan plan;
    plan.links.resize(1);
    plan.links[0].*end = "fake-vehicle-*";
    EXPECT_EQ(schedule(plan, kServices, kWorld, 1).size(), 2u);
    plan.links[0].*end = "local-planer-agv-1";
    try {
      schedule(plan, kServices, kWorld, 1);
      FAIL() << "was taken";
    } catch (const config::BadInput& refused) {
      EXPECT_THAT(refused.what(), HasSubstr("did you mean 'local-planner-agv-1'"));
    }
  }
}

TEST(FaultSchedule, HarmsOfOneLinkAddUpWhileTheyLast) {
  FaultPlan plan;
  plan.stop_s = 60.0;
  plan.links.resize(2);
  plan.links[0].loss = 0.5;
  plan.links[0].delay_ms = 10.0;
  plan.links[1].from = "map";
  plan.links[1].begin_s = 10.0;
  plan.links[1].for_s = 10.0;
  plan.links[1].loss = 0.5;
  plan.links[1].delay_ms = 20.0;
  EXPECT_DOUBLE_EQ(harm_at(plan, 5s, "map", "x").loss, 0.5);
  EXPECT_DOUBLE_EQ(harm_at(plan, 10s, "map", "x").loss, 0.75);
  EXPECT_DOUBLE_EQ(harm_at(plan, 10s, "map", "x").delay_ms, 30.0);
  EXPECT_DOUBLE_EQ(harm_at(plan, 10s, "x", "map").loss, 0.5);
  EXPECT_DOUBLE_EQ(harm_at(plan, 20s, "map", "x").loss, 0.5);
  EXPECT_DOUBLE_EQ(harm_at(plan, 60s, "map", "x").loss, 0.0) << "the plan stopped";
}

/// Their products with 1e9 fall short of a whole number of nanoseconds.
TEST(FaultSchedule, HarmBeginsAndEndsExactlyWithTheActionsThatSaySo) {
  for (const double stop_s : {60.0, 4.02}) {
    FaultPlan plan;
    plan.stop_s = stop_s;
    plan.links.resize(2);
    plan.links[0].begin_s = 2.01;
    plan.links[0].for_s = stop_s > 4.02 ? 2.01 : 30.0;
    plan.links[0].loss = 1.0;
    plan.links[1].for_s = 4.02;
    plan.links[1].delay_ms = 20.0;
    const std::vector<FaultAction> actions = schedule(plan, kServices, kWorld, 1);
    ASSERT_EQ(actions.size(), 4u);
    EXPECT_EQ(harm_at(plan, moment_of(actions[0].t_s), "map", "x").delay_ms, 20.0);
    EXPECT_EQ(harm_at(plan, moment_of(actions[1].t_s), "map", "x").loss, 1.0) << "begins at 2.01 s";
    EXPECT_EQ(harm_at(plan, moment_of(actions[3].t_s), "map", "x").loss, 0.0) << "over at 4.02 s";
    EXPECT_EQ(harm_at(plan, moment_of(actions[3].t_s), "map", "x").delay_ms, 0.0) << "over at 4.02 s";
    EXPECT_EQ(moment_of(actions[3].t_s), 4020ms);
  }
}

}  // namespace
}  // namespace aisle::sim
