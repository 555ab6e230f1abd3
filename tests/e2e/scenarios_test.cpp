#include <gtest/gtest.h>

#include "tests/e2e/demo_run.hpp"
#include "tests/e2e/verdicts.hpp"

namespace aisle::e2e {
namespace {

TEST(Scenarios, CrossingIsDriven) {
  const DemoRun run = run_demo("crossing", {"crossing", "--seed", "1"}, 120.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_GT(run.report["least_clearance_m"].get<double>(), 0.0);
}

/// In reverse order of start; the map comes when all others wait for it, a local planner when its goal was given long ago.
TEST(Scenarios, CrossingIsDrivenWhoeverComesLate) {
  const DemoRun run = run_demo("crossing-late", {"crossing", "--seed", "2", "--reversed", "--delay", "map@3", "--delay", "local-planner-agv-2@8"}, 150.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
}

TEST(Scenarios, BlockedAisleIsDrivenAround) {
  const DemoRun run = run_demo("blocked-aisle", {"blocked-aisle", "--seed", "1"}, 200.0);
  expect_passed(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_GT(run.report["replans"].get<int>(), 0) << "nothing was in the way";
}

TEST(Scenarios, WarehouseIsDriven) {
  const DemoRun run = run_demo("warehouse", {"warehouse", "--seed", "1"}, 330.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_GE(run.report["vehicles"].get<int>(), 5);
  EXPECT_GT(run.report["least_clearance_m"].get<double>(), 0.0);
  ASSERT_FALSE(run.report["map_edits"].empty());
  EXPECT_EQ(run.report["map_edits"][0]["outcome"], "applied");
}

TEST(Scenarios, DepotIsDrivenAmongRecordedPeople) {
  if (!has_reference_data()) GTEST_SKIP() << "no reference data; set AISLE_DATA";
  expect_passed(run_demo("depot-pedestrians", {"depot-pedestrians", "--seed", "1"}, 330.0));
}

TEST(Scenarios, MovingAiWarehouseIsDriven) {
  if (!has_reference_data()) GTEST_SKIP() << "no reference data; set AISLE_DATA";
  const DemoRun run = run_demo("movingai-warehouse", {"movingai-warehouse", "--seed", "1"}, 330.0);
  expect_passed(run);
  EXPECT_EQ(run.report["contacts"], 0);
}

}  // namespace
}  // namespace aisle::e2e
