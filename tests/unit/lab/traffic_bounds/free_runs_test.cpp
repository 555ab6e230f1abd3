#include "tools/lab/traffic_bounds/free_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/lab/traffic_bounds/graphs.hpp"

namespace aisle::lab {
namespace {

TEST(FreeRuns, EachVehicleIsAloneWithItsOwnMission) {
  scenario::Scenario fleet;
  for (const char* id : {"agv-1", "agv-2", "agv-3"}) {
    scenario::Vehicle vehicle;
    vehicle.id = id;
    fleet.vehicles.push_back(vehicle);
    scenario::Mission mission;
    mission.vehicle = id;
    fleet.missions.push_back(mission);
  }

  std::vector<std::string> seen;
  const std::vector<GoalTimes> times = free_runs(fleet, 2, [&](const scenario::Scenario& one) {
    EXPECT_EQ(one.vehicles.size(), 1U);
    EXPECT_EQ(one.missions.size(), 1U);
    EXPECT_EQ(one.missions.front().vehicle, one.vehicles.front().id);
    seen.push_back(one.vehicles.front().id);
    return GoalTimes{static_cast<double>(seen.size())};
  });

  EXPECT_EQ(seen, (std::vector<std::string>{"agv-1", "agv-2"}));
  EXPECT_EQ(times, (std::vector<GoalTimes>{{1.0}, {2.0}}));
}

// Four steps there and two back in 12.5 s, with a pause of 0.5 s between.
TEST(FreeRuns, SecondsAStepLeaveThePausesOut) {
  const FleetOnGraph fleet{{0}, {std::vector<Vertex>{4, 2, 0}}, {4}};

  EXPECT_DOUBLE_EQ(seconds_a_step(line(5), fleet, {{8.0, 12.5}}, 0.5), 2.0);
  EXPECT_TRUE(std::isnan(seconds_a_step(line(5), fleet, {{}}, 0.5)));
}

}  // namespace
}  // namespace aisle::lab
