// A few scenarios of the suite; all of them are `aisle experiment local`.
#include "tools/sim/suite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/config/reader.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/scenarios/suite_scenarios.hpp"

namespace aisle::sim {
namespace {

std::string name_of(const testing::TestParamInfo<std::string>& of) {
  std::string name = of.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Suite : public testing::TestWithParam<std::string> {};

TEST_P(Suite, ReachesItsGoalsInTimeAndTouchesNothing) {
  const SuiteRow row = run_family(GetParam(), "wang", 1, 1);
  EXPECT_EQ(row.totals.goals_reached, row.totals.goals_assigned) << (row.bad.empty() ? "" : row.bad.front());
  EXPECT_EQ(row.totals.contacts_moving_vehicle, 0) << (row.bad.empty() ? "" : row.bad.front());
}

INSTANTIATE_TEST_SUITE_P(Families, Suite,
                         testing::Values("static-clutter", "hidden-blocks", "person-crossing", "overtaking", "door",
                                         "corridor", "two-vehicles"),
                         name_of);

class Fused : public testing::TestWithParam<std::string> {};

TEST_P(Fused, AvoidsPeopleWhoCross) {
  const SuiteRow row = run_family("person-crossing", GetParam(), 1, 1);
  EXPECT_EQ(row.totals.goals_reached, 1) << (row.bad.empty() ? "" : row.bad.front());
  EXPECT_EQ(row.totals.contacts_moving_vehicle, 0) << (row.bad.empty() ? "" : row.bad.front());
}

INSTANTIATE_TEST_SUITE_P(Planners, Fused, testing::Values("li", "wu", "qu", "yu"), name_of);

TEST(SuiteScenarios, LeadEverybodyToTheirGoal) {
  for (const std::string& family : suite_families()) {
    if (family == "crowd") continue;  // needs the reference data
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      for (const double seconds : free_run_s(make_setup(family, seed)))
        EXPECT_TRUE(std::isfinite(seconds) && seconds > 5.0) << family << " " << seed;
  }
}

/// A lidar does not see through walls, so nobody may come through one.
TEST(SuiteScenarios, KeepRecordedPeopleWithinTheWalls) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    sim::Setup setup;
    try {
      setup = make_setup("crowd", seed);
    } catch (const config::BadInput& missing) {
      GTEST_SKIP() << missing.what();
    }
    const grid::Geometry& hall = setup.grid.geometry();
    const double right_m = hall.width * hall.resolution_m - 0.25;
    const double top_m = hall.height * hall.resolution_m - 0.25;
    ASSERT_FALSE(setup.people.front().empty());
    for (const fake_world::RecordedPerson& person : setup.people.front())
      for (const auto& row : person.rows())
        ASSERT_TRUE(row.in_map.x > 0.25 && row.in_map.x < right_m && row.in_map.y > 0.25 && row.in_map.y < top_m)
            << "seed " << seed << ": " << person.id() << " at (" << row.in_map.x << ", " << row.in_map.y << ")";
  }
}

TEST(SuiteScenarios, CountAGoalBehindAClosedAisleAsMissed) {
  sim::Setup setup = make_setup("overtaking", 1);
  setup.scenario.movers.clear();
  scenario::Block wall;
  wall.id = "wall";
  wall.center_in_map = {10.0, 2.0, 0.0};
  wall.width_m = 6.0;
  setup.scenario.blocks.push_back(wall);
  const double limit_s = kFreeRuns * free_run_s(setup).front();
  const Result result = run_in_time(setup, "wang");
  EXPECT_EQ(result.goals_reached, 0);
  EXPECT_EQ(result.contacts, 0);
  EXPECT_NEAR(result.driven_s, limit_s, 0.1);
}

}  // namespace
}  // namespace aisle::sim
