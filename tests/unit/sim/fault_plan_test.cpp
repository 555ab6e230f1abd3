// Fault plans as files, and those made from a seed.
#include "tools/sim/fault_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "common/config/yaml_reader.hpp"
#include "tests/support/places.hpp"

namespace aisle::sim {
namespace {

using ::testing::HasSubstr;

FaultPlan plan_of(const std::string& text) {
  FaultPlan plan;
  config::read_yaml_text(text, "plan.yaml", plan);
  return plan;
}

std::string refusal_of(const std::string& text) {
  try {
    plan_of(text);
  } catch (const config::BadInput& refused) {
    return refused.what();
  }
  return "was taken";
}

TEST(FaultPlan, ReadsEveryKindOfFault) {
  const FaultPlan plan = plan_of(R"(
stop_s: 30.0
links:
  - {from: "fake-vehicle-*", to: map, begin_s: 1.0, for_s: 2.0, loss: 0.1, delay_ms: 5.0, jitter_ms: 6.0, duplicates: 0.2, reordered: 0.3, reorder_ms: 7.0}
cuts:
  - {from: map, to: dispatcher, at_s: 3.0, every_s: 4.0, for_s: 5.0, both_ways: false}
crashes:
  - {process: map, at_s: 6.0, restart_after_s: 7.0}
hangs:
  - {process: map, at_s: 8.0, for_s: 9.0}
clock_jumps:
  - {process: map, at_s: 10.0, by_s: -11.0}
disks:
  - {process: map, at_s: 12.0, kind: torn}
holds:
  - {vehicle: agv-1, begin_s: 13.0, every_s: 14.0, least_s: 15.0, most_s: 16.0}
slows:
  - {vehicle: agv-2, begin_s: 17.0, for_s: 18.0, share: 0.7}
deaths:
  - {vehicle: agv-3, at_s: 19.0, signed_off_after_s: 20.0}
)");
  EXPECT_EQ(plan.stop_s, 30.0);
  ASSERT_EQ(plan.links.size(), 1u);
  EXPECT_EQ(plan.links[0].from, "fake-vehicle-*");
  EXPECT_EQ(plan.links[0].reorder_ms, 7.0);
  ASSERT_EQ(plan.cuts.size(), 1u);
  EXPECT_EQ(plan.cuts[0].every_s, 4.0);
  EXPECT_FALSE(plan.cuts[0].both_ways);
  ASSERT_EQ(plan.crashes.size(), 1u);
  EXPECT_EQ(plan.crashes[0].restart_after_s, 7.0);
  ASSERT_EQ(plan.hangs.size(), 1u);
  EXPECT_EQ(plan.hangs[0].for_s, 9.0);
  ASSERT_EQ(plan.clock_jumps.size(), 1u);
  EXPECT_EQ(plan.clock_jumps[0].by_s, -11.0);
  ASSERT_EQ(plan.holds.size(), 1u);
  EXPECT_EQ(plan.holds[0].vehicle, "agv-1");
  EXPECT_EQ(plan.holds[0].every_s, 14.0);
  EXPECT_EQ(plan.holds[0].most_s, 16.0);
  ASSERT_EQ(plan.slows.size(), 1u);
  EXPECT_EQ(plan.slows[0].for_s, 18.0);
  EXPECT_EQ(plan.slows[0].share, 0.7);
  ASSERT_EQ(plan.deaths.size(), 1u);
  EXPECT_EQ(plan.deaths[0].vehicle, "agv-3");
  EXPECT_EQ(plan.deaths[0].at_s, 19.0);
  EXPECT_EQ(plan.deaths[0].signed_off_after_s, 20.0);
  ASSERT_EQ(plan.disks.size(), 1u);
  EXPECT_EQ(plan.disks[0].kind, "torn");
}

TEST(FaultPlan, NamesWhatItCannotTake) {
  EXPECT_THAT(refusal_of("links:\n  - {loss: 1.5}\n"), HasSubstr("loss"));
  EXPECT_THAT(refusal_of("crash: []\n"), HasSubstr("crashes"));
  EXPECT_THAT(refusal_of("disks:\n  - {kind: burnt}\n"), HasSubstr("burnt"));
  EXPECT_THAT(refusal_of("hangs:\n  - {at_s: -1.0}\n"), HasSubstr("at_s"));
  EXPECT_THAT(refusal_of("hangs:\n  - {every_s: 1e-8}\n"), HasSubstr("every_s: neither 0 nor"));
  EXPECT_THAT(refusal_of("holds:\n  - {least_s: 3.0, most_s: 2.0}\n"), HasSubstr("most_s: less than least_s"));
  EXPECT_THAT(refusal_of("slows:\n  - {share: 0.0}\n"), HasSubstr("share"));
  EXPECT_EQ(plan_of("hangs:\n  - {every_s: 0.01}\n").hangs[0].every_s, 0.01);
}

TEST(FaultPlan, APlanFromASeedIsTheSamePlanEachTimeAndFromItsOwnText) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const FaultPlan plan = random_fault_plan(seed);
    EXPECT_FALSE(plan.is_empty()) << seed;
    EXPECT_EQ(plan.stop_s, 60.0);
    const std::string text = to_yaml(plan);
    EXPECT_EQ(text, to_yaml(random_fault_plan(seed)));
    EXPECT_EQ(text, to_yaml(plan_of(text))) << text;
  }
  EXPECT_NE(to_yaml(random_fault_plan(1)), to_yaml(random_fault_plan(2)));
}

TEST(FaultPlan, TheSamplesAreRead) {
  for (const char* name : {"loss", "crashes", "delays", "cuts"}) {
    const FaultPlan plan =
        read_fault_plan(test_support::source_folder() / "deploy/faults" / (std::string(name) + ".yaml"));
    EXPECT_EQ(plan.stop_s, 60.0) << name;
    EXPECT_FALSE(plan.is_empty()) << name;
  }
}

TEST(FaultPlan, TheDisturbanceHoldsAndSlowsEachVehicleAndLosesPackets) {
  const FaultPlan plan = read_fault_plan(test_support::source_folder() / "deploy/faults/disturbed.yaml");
  ASSERT_EQ(plan.holds.size(), 1u);
  EXPECT_EQ(plan.holds[0].every_s, 60.0);
  EXPECT_EQ(plan.holds[0].least_s, 2.0);
  EXPECT_EQ(plan.holds[0].most_s, 8.0);
  ASSERT_EQ(plan.slows.size(), 1u);
  EXPECT_EQ(plan.slows[0].share, 0.8);
  ASSERT_EQ(plan.links.size(), 1u);
  EXPECT_EQ(plan.links[0].loss, 0.1);
}

TEST(FaultPlan, AStarStandsForAnyText) {
  EXPECT_TRUE(is_named("*", "map"));
  EXPECT_TRUE(is_named("map", "map"));
  EXPECT_TRUE(is_named("local-planner-*", "local-planner-agv-1"));
  EXPECT_TRUE(is_named("*-agv-1", "local-planner-agv-1"));
  EXPECT_TRUE(is_named("*planner*", "local-planner-agv-1"));
  EXPECT_TRUE(is_named("map*", "map"));
  EXPECT_FALSE(is_named("local-planner-*", "global-planner"));
  EXPECT_FALSE(is_named("map", "map-2"));
  EXPECT_FALSE(is_named("*-agv-1", "local-planner-agv-10"));
  EXPECT_FALSE(is_named("", "map"));
}

}  // namespace
}  // namespace aisle::sim
