#include <gtest/gtest.h>

#include <string>
#include <vector>

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

/// One after the other, while both vehicles are on their way.
TEST(Restarts, OfEveryServiceInOneRun) {
  const std::vector<std::string> killed{"map",        "global-planner",     "obstacle-tracker", "local-planner-agv-1",
                                        "dispatcher", "fake-vehicle-agv-2", "fake-world"};
  std::vector<std::string> arguments{"crossing", "--seed", "4"};
  int at_s = 3;
  for (const std::string& instance : killed) {
    arguments.insert(arguments.end(), {"--kill", instance + "@" + std::to_string(at_s)});
    at_s += 3;
  }
  const DemoRun run = run_demo("restarts", arguments, 200.0);
  expect_passed(run);
  expect_clean(run);
  EXPECT_EQ(run.report["contacts"], 0);
  EXPECT_EQ(run.processes["kills"], killed.size()) << run.output;
  expect_restarted(run, killed);
}

}  // namespace
}  // namespace aisle::e2e
