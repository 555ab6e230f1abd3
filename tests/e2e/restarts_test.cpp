#include <gtest/gtest.h>

#include "tests/e2e/demo_run.hpp"
#include "tests/e2e/verdicts.hpp"

namespace aisle::e2e {
namespace {

/// Every process that was killed is up again at the end, in a second life.
void expect_restarted(const DemoRun& run, const std::vector<std::string>& instances) {
  for (const std::string& instance : instances) {
    bool found = false;
    for (const nlohmann::json& row : run.report["service_rows"]) {
      if (row["instance"] != instance) continue;
      found = true;
      EXPECT_GE(row["starts"].get<int>(), 2) << instance;
    }
    EXPECT_TRUE(found) << instance;
  }
}

TEST(Restarts, OfMapTrackerAndDispatcher) {
  const DemoRun run = run_demo("restarts-site", {"crossing", "--seed", "4", "--kill", "map@5", "--kill", "obstacle-tracker@8", "--kill", "dispatcher@11"}, 200.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_EQ(run.processes["kills"], 3) << run.output;
  expect_restarted(run, {"map", "obstacle-tracker", "dispatcher"});
}

TEST(Restarts, OfThePlannersAndTheSimulation) {
  const DemoRun run = run_demo("restarts-fleet",
                               {"crossing", "--seed", "5", "--kill", "global-planner@5", "--kill", "local-planner-agv-1@8", "--kill",
                                "fake-vehicle-agv-2@11", "--kill", "fake-world@13"},
                               200.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_EQ(run.processes["kills"], 4) << run.output;
  expect_restarted(run, {"global-planner", "local-planner-agv-1", "fake-vehicle-agv-2", "fake-world"});
}

}  // namespace
}  // namespace aisle::e2e
