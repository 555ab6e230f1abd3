#include "tools/demo/fleet.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "common/config/reader.hpp"
#include "tests/support/places.hpp"

namespace aisle::demo {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

scenario::Scenario two_vehicles() {
  scenario::Scenario scenario;
  scenario.vehicles.resize(2);
  scenario.vehicles[0].id = "agv-1";
  scenario.vehicles[1].id = "agv-2";
  return scenario;
}

RunSettings settings() {
  RunSettings s;
  s.scenario_file = "/somewhere/crossing.yaml";
  s.out = "/tmp/out";
  s.domain = 123;
  s.seed = 7;
  return s;
}

TEST(Fleet, HasEveryServiceOnceAndTwoForEachVehicle) {
  const std::vector<Process> processes = processes_of(two_vehicles(), settings());
  std::set<std::string> instances;
  for (const Process& p : processes) instances.insert(p.instance);
  EXPECT_EQ(instances, (std::set<std::string>{"map", "global-planner", "obstacle-tracker", "fake-world",
                                              "fake-vehicle-agv-1", "fake-vehicle-agv-2", "local-planner-agv-1",
                                              "local-planner-agv-2", "dispatcher", "referee"}));
  EXPECT_TRUE(processes.front().is_referee);
}

TEST(Fleet, TogetherHasOneProcessThatSimulatesAllVehiclesAndOneThatDrivesThem) {
  RunSettings together = settings();
  together.together = true;
  std::set<std::string> instances;
  for (const Process& p : processes_of(two_vehicles(), together)) {
    instances.insert(p.instance);
    if (p.instance != "fake-vehicle" && p.instance != "local-planner") continue;
    const auto agv = std::find(p.arguments.begin(), p.arguments.end(), "--agv");
    ASSERT_NE(agv, p.arguments.end()) << p.instance;
    EXPECT_EQ(*std::next(agv), "agv-1,agv-2");
  }
  EXPECT_EQ(instances, (std::set<std::string>{"map", "global-planner", "obstacle-tracker", "fake-world", "fake-vehicle",
                                              "local-planner", "dispatcher", "referee"}));
}

TEST(Fleet, StaysOnLoopbackOnItsDomain) {
  for (const Process& p : processes_of(two_vehicles(), settings())) {
    const auto domain = std::find(p.arguments.begin(), p.arguments.end(), "--domain");
    ASSERT_NE(domain, p.arguments.end());
    EXPECT_EQ(*std::next(domain), "123");
    const auto interface = std::find(p.arguments.begin(), p.arguments.end(), "--interface");
    ASSERT_NE(interface, p.arguments.end());
    EXPECT_EQ(*std::next(interface), "127.0.0.1");
  }
}

TEST(Fleet, StartsTheServicesInReverseOrderOnRequest) {
  RunSettings s = settings();
  const std::vector<Process> forward = processes_of(two_vehicles(), s);
  s.reversed = true;
  const std::vector<Process> backward = processes_of(two_vehicles(), s);
  EXPECT_EQ(forward[1].instance, "map");
  EXPECT_EQ(backward.back().instance, "map");
  EXPECT_TRUE(backward.front().is_referee);
}

TEST(Fleet, NamesTheScenariosThatThereAre) {
  try {
    find_scenario("no-such-scenario", test_support::source_folder().string() + "/build/bin");
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("no scenario 'no-such-scenario'"));
  }
}

}  // namespace
}  // namespace aisle::demo
