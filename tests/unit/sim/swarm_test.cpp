// A few runs of the swarm; .ci/night drives the many.
#include "tools/sim/swarm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace aisle::sim {
namespace {

TEST(Swarm, ACaseIsDrawnByItsSeedAndFewerThanHalfOfTheFleetDie) {
  int fleets_with_dead = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const SwarmCase swarm = swarm_case(seed);
    const std::size_t fleet = swarm.setup.scenario.vehicles.size();

    EXPECT_EQ(to_yaml(swarm.plan), to_yaml(swarm_case(seed).plan));
    EXPECT_GE(fleet, 3u);
    EXPECT_LE(fleet, 5u);
    EXPECT_LT(2 * swarm.dead.size(), fleet);
    EXPECT_GE(swarm.last_fault_s, swarm.plan.stop_s);
    fleets_with_dead += swarm.dead.empty() ? 0 : 1;
  }

  EXPECT_GT(fleets_with_dead, 5);
}

class SwarmSeed : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SwarmSeed, TouchesNothingHoldsNoFloorTwiceAndLosesNoGoal) {
  const SwarmCase swarm = swarm_case(GetParam());
  const SwarmVerdict verdict = drive_swarm_case(swarm);

  for (const std::string& failure : verdict.failures) ADD_FAILURE() << failure;
  EXPECT_EQ(verdict.reached + verdict.closed_off, verdict.goals);
  EXPECT_FALSE(verdict.outcome.faults.empty());
}

INSTANTIATE_TEST_SUITE_P(Seeds, SwarmSeed, ::testing::Values(2, 3));

}  // namespace
}  // namespace aisle::sim
