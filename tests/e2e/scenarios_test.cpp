#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/e2e/demo_run.hpp"
#include "tests/e2e/verdicts.hpp"
#include "tests/support/places.hpp"

namespace aisle::e2e {
namespace {

namespace fs = std::filesystem;

TEST(Scenarios, CrossingIsDriven) {
  const DemoRun run = run_demo("crossing", {"crossing", "--seed", "1"}, 120.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_GT(run.report["least_clearance_m"].get<double>(), 0.0);
}

/// One process simulates both vehicles, one drives both.
TEST(Scenarios, CrossingIsDrivenByVehiclesThatShareAProcess) {
  const DemoRun run = run_demo("crossing-together", {"crossing", "--seed", "1", "--together"}, 120.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_EQ(run.processes["processes"], 8);
}

/// In reverse order of start; the map comes when all others wait for it, a local planner when its goal was given long
/// ago.
TEST(Scenarios, CrossingIsDrivenWhoeverComesLate) {
  const DemoRun run = run_demo(
      "crossing-late",
      {"crossing", "--seed", "2", "--reversed", "--delay", "map@3", "--delay", "local-planner-agv-2@8"}, 150.0);
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

/// deploy/config, with `line` of the obstacle tracker's file changed to `changed`.
std::string configuration_with(const std::string& line, const std::string& changed) {
  const fs::path folder = test_support::program_folder() / "../e2e/config-changed";
  fs::remove_all(folder);
  fs::create_directories(folder.parent_path());
  fs::copy(test_support::source_folder() / "deploy/config", folder);
  std::ifstream in(folder / "obstacle-tracker.yaml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  if (at != std::string::npos) text.replace(at, line.size(), changed);
  std::ofstream(folder / "obstacle-tracker.yaml") << text;
  return folder.string();
}

TEST(Scenarios, AroundTheCornerAPersonThatTheOtherVehicleSeesIsAvoided) {
  const DemoRun run = run_demo("around-the-corner", {"around-the-corner", "--seed", "1"}, 100.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_GE(run.report["least_clearance_vehicle_person_m"].get<double>(),
            run.report["person_clearance_asked_m"].get<double>());
  EXPECT_GT(run.report["person_clearance_asked_m"].get<double>(), 0.0);
}

/// The same run, but for one line: what agv-2 sees does not reach the tracker.
TEST(Scenarios, AroundTheCornerAPersonIsMetTooLateWithoutFusion) {
  const std::string config = configuration_with("only_scans_of: \"\"", "only_scans_of: agv-1");
  const DemoRun run =
      run_demo("around-the-corner-alone", {"around-the-corner", "--seed", "1", "--config", config}, 100.0);
  ASSERT_TRUE(run.report.is_object()) << run.output;
  EXPECT_EQ(run.code, 1) << run.output;
  EXPECT_LT(run.report["least_clearance_vehicle_person_m"].get<double>(),
            run.report["person_clearance_asked_m"].get<double>())
      << run.output;
  EXPECT_EQ(run.report["passed"], false);
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

/// A tricycle of 2.4 x 1.1 m, an omnidirectional cart and a differential vehicle.
TEST(Scenarios, ForkliftIsDriven) {
  const DemoRun run = run_demo("forklift", {"forklift", "--seed", "1"}, 260.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_GT(run.report["least_clearance_m"].get<double>(), 0.0);
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
