// Each paper's local planner on its map, as printed: whole drives on the simulated site.
#include "tools/lab/driving/printed_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <ostream>
#include <string>

#include "tests/support/places.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

const std::filesystem::path kMaps = test_support::source_folder() / "deploy/experiments";

struct PaperDrive {
  const char* variant;
  const char* map;
  friend std::ostream& operator<<(std::ostream& out, const PaperDrive& drive) {
    return out << drive.variant << " on " << drive.map;
  }
};

sim::Setup setup_of(const PaperDrive& drive) {
  const local_planner::Variant& variant = *local_planner::find_variant(drive.variant);
  return printed_setup(read_drawn_map(kMaps / (std::string(drive.map) + ".txt"), 1.0), variant,
                       global_planner_of(variant));
}

class PrintedDrive : public testing::TestWithParam<PaperDrive> {};

/// Whether a paper's drive arrives is a finding and no requirement: an honest "touches" or "never arrives" passes, is
/// printed, and stands in the report with its reason.
TEST_P(PrintedDrive, DrivesItsPapersMapAndSaysHowItEnds) {
  const sim::Outcome outcome = sim::drive(setup_of(GetParam()));
  ASSERT_EQ(outcome.result.goals_assigned, 1);
  EXPECT_GT(outcome.result.distance_m, 1.0);
  EXPECT_EQ(outcome.result.replans, 0) << "the path of the paper's own planner, once";
  EXPECT_TRUE(outcome.report.violations.empty());

  std::string end = outcome.result.goals_reached == 1 ? "arrives" : "never arrives";
  if (outcome.result.contacts_moving_vehicle > 0)
    end += ", touches " + std::to_string(outcome.result.contacts_moving_vehicle) + " times";
  std::printf("%s on %s: %s, %.2f m in %.1f s, planned %.2f m\n", GetParam().variant, GetParam().map, end.c_str(),
              outcome.result.distance_m, outcome.result.time_s, outcome.result.planned_m);
  RecordProperty("end", end);
  if (outcome.result.goals_reached == 0) {
    ASSERT_EQ(outcome.report.goals.size(), 1u);
    EXPECT_FALSE(outcome.report.goals.front().reason.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachPaper, PrintedDrive,
                         testing::Values(PaperDrive{"li", "li-complex"}, PaperDrive{"wu", "wu"},
                                         PaperDrive{"qu", "qu-simple"}, PaperDrive{"qu", "qu-maze"},
                                         PaperDrive{"yu", "yu-1"}, PaperDrive{"yu", "yu-2"},
                                         PaperDrive{"wang", "wang-1"}),
                         [](const auto& drive) {
                           std::string name = std::string(drive.param.variant) + "_" + drive.param.map;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

TEST(PrintedSetup, HasTheVehicleAndTheStartOfThePaper) {
  const sim::Setup wu = setup_of({"wu", "wu"}), qu = setup_of({"qu", "qu-maze"}), wang = setup_of({"wang", "wang-1"});
  EXPECT_EQ(wu.scenario.vehicles[0].kinematic_model(), kinematics::Model::kTricycle);
  EXPECT_EQ(wang.scenario.vehicles[0].kinematic_model(), kinematics::Model::kDifferential);
  EXPECT_DOUBLE_EQ(qu.scenario.vehicles[0].start_in_map.yaw, -0.5 * geometry::kPi) << "QU, table 1";
  EXPECT_NEAR(wang.scenario.vehicles[0].start_in_map.yaw, 0.25 * geometry::kPi, 1e-9) << "none printed: to the goal";
  EXPECT_DOUBLE_EQ(wang.scenario.vehicles[0].start_in_map.x, 1.5);
  EXPECT_DOUBLE_EQ(wang.scenario.missions[0].goals_in_map[0].x, 19.5);
  EXPECT_EQ(wang.planner, "wang");
  EXPECT_EQ(global_planner_of(*local_planner::find_variant("dwa")), "direct");
}

TEST(PrintedSetup, DrivesTheSameTwiceAndAnUnknownBoxMakesNoNewPlan) {
  sim::Setup setup = setup_of({"wang", "wang-1"});
  scenario::Block box;
  box.id = "box-1";
  box.center_in_map = {5.5, 5.5, 0.0};
  box.length_m = box.width_m = 0.5;
  setup.scenario.blocks.push_back(box);
  setup.scenario.duration_s = 30.0;
  const sim::Outcome outcome = sim::drive(setup);
  EXPECT_EQ(outcome.result.replans, 0);
  EXPECT_EQ(sim::drive(setup).result.trace_hash, outcome.result.trace_hash);
}

/// No leader grants road: the planner publishes the path as the paper has it.
TEST(PrintedSetup, HasNeitherALimitNorATube) {
  int with_plan = 0;
  sim::Hooks hooks;
  hooks.watch = [&](const sim::Snapshot& now) {
    const local_planner::Output& output = now.outputs[0];
    EXPECT_NE(output.reason, local_planner::Reason::kNoGrant);
    EXPECT_EQ(output.road.limit_step, 0U);
    EXPECT_EQ(output.road.grant_number, 0U);
    EXPECT_TRUE(output.road.held.empty());

    if (now.plans[0] == nullptr) return;
    ++with_plan;
    EXPECT_TRUE(now.plans[0]->step_ends_m.empty());
    EXPECT_EQ(now.plans[0]->tube_m, 0.0);
  };

  sim::Setup setup = setup_of({"wang", "wang-1"});
  setup.scenario.duration_s = 20.0;
  EXPECT_GT(sim::drive(setup, {}, hooks).result.distance_m, 5.0);
  EXPECT_GT(with_plan, 0);
}

}  // namespace
}  // namespace aisle::lab
