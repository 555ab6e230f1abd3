// The rooms of the traffic together, on small maps: every goal, no contact, no floor held twice, nobody stands off.
#include "tools/lab/traffic/kinematic_site.hpp"

#include <gtest/gtest.h>

#include "common/scenario/scenario.hpp"
#include "tests/support/places.hpp"

namespace aisle::lab {
namespace {

constexpr double kLongestStandoffS = 5.0;

scenario::Scenario read(const std::string& name) {
  return scenario::read_scenario(test_support::source_folder() / "tests/data/traffic" / (name + ".yaml"));
}

TrafficRun drive(const scenario::Scenario& scenario, TrafficRunSettings settings = {}) {
  return KinematicSite(scenario, settings).run();
}

void expect_good(const TrafficRun& run) {
  EXPECT_EQ(run.goals, run.goals_wanted) << "stands: " << run.wait.agv_id << " " << run.wait.cause;
  EXPECT_TRUE(run.is_clean()) << (run.findings.empty() ? "refused or circles" : run.findings.front());
  EXPECT_LE(run.standoff.seconds, kLongestStandoffS) << run.standoff.agv_id << " " << run.standoff.cause;
}

struct Case {
  std::string scenario;
  bool is_disturbed{false};
};

class TrafficCase : public testing::TestWithParam<Case> {};

TEST_P(TrafficCase, ReachesAllGoals) {
  const scenario::Scenario scenario = read(GetParam().scenario);

  for (const std::uint64_t seed : {1U, 2U}) {
    TrafficRunSettings settings;
    settings.seed = seed;
    if (GetParam().is_disturbed) settings.disturbance = Disturbance::usual();
    expect_good(drive(scenario, settings));
  }
}

INSTANTIATE_TEST_SUITE_P(Small, TrafficCase,
                         testing::Values(Case{"two-against-two", false}, Case{"two-against-two", true},
                                         Case{"parked-in-lane", false}, Case{"parked-in-lane", true},
                                         Case{"one-goal-for-three", false}, Case{"one-goal-for-three", true}));

TEST(KinematicSite, TheSameSeedGivesTheSameRun) {
  TrafficRunSettings settings;
  settings.disturbance = Disturbance::usual();
  const scenario::Scenario scenario = read("two-against-two");
  const TrafficRun a = drive(scenario, settings);
  const TrafficRun b = drive(scenario, settings);

  EXPECT_EQ(a.last_goal_s, b.last_goal_s);
  EXPECT_EQ(a.driven_m, b.driven_m);
  EXPECT_EQ(a.events, b.events);
}

TEST(KinematicSite, ALeaderThatForgetsAllGoesOnFromWhatVehiclesSay) {
  TrafficRunSettings settings;
  settings.restart_of_the_leader_s = 12.0;
  expect_good(drive(read("two-against-two"), settings));
}

TEST(KinematicSite, AloneAVehicleDrivesItsOwnWay) {
  scenario::Scenario scenario = read("parked-in-lane");
  scenario.vehicles.pop_back();
  const TrafficRun run = drive(scenario);

  expect_good(run);
  EXPECT_GT(run.own_way_share, 0.99);
  EXPECT_NEAR(run.driven_m, 12.2, 0.3);
}

TEST(KinematicSite, ADeadVehicleInTheOnlyWayStopsOthersWithoutAContact) {
  TrafficRunSettings settings;
  settings.deaths.push_back({"agv-2", 1.0});
  const TrafficRun run = drive(read("parked-in-lane"), settings);

  EXPECT_EQ(run.goals, 0);
  EXPECT_TRUE(run.is_clean());
}

}  // namespace
}  // namespace aisle::lab
