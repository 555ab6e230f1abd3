// Plain PIBT on graphs on which its steps can be counted by hand.
#include "tools/lab/traffic_bounds/pibt_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/lab/traffic_bounds/graphs.hpp"

namespace aisle::lab {
namespace {

TEST(PibtBound, OneVehicleNeedsTheStepsOfItsShortestWays) {
  const StepGraph graph = line(5);
  const PibtFleet to_and_fro{{0}, {std::vector<Vertex>{4, 0, 4, 0, 4, 0, 4, 0, 4, 0}}};
  const PibtRun run = run_pibt(graph, to_and_fro, 40, 1);

  EXPECT_EQ(run.goals, 10U);
  EXPECT_DOUBLE_EQ(run.steps_a_goal(1), 4.0);
}

TEST(PibtBound, AFullRingTurnsAtOnce) {
  const StepGraph ring = graph_of(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  PibtFleet fleet{{0, 1, 2, 3}, {{}, {}, {}, {}}};
  for (Vertex v = 0; v < 4; ++v)
    for (Vertex step = 1; step <= 12; ++step) fleet.goals[v].push_back((v + step) % 4);
  const PibtRun run = run_pibt(ring, fleet, 12, 1);

  EXPECT_EQ(run.goals, 48U);
  EXPECT_DOUBLE_EQ(run.steps_a_goal(4), 1.0);
}

// A ring 0 - 1 - 2 - 3 - 4 - 0, each wants to where the other stands. The first one drives 0, 1, 2; the other one,
// whose way over 1 is taken, goes round by 3 and 4.
TEST(PibtBound, OfTwoThatMeetOneGoesRound) {
  const StepGraph ring = graph_of(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}});
  const PibtFleet fleet{{0, 2}, {std::vector<Vertex>{2}, std::vector<Vertex>{0}}};

  EXPECT_EQ(run_pibt(ring, fleet, 2, 1).goals, 1U);
  EXPECT_EQ(run_pibt(ring, fleet, 3, 1).goals, 2U);
}

TEST(PibtBound, AGoalUnderTheVehicleIsReachedAtOnce) {
  const PibtRun run = run_pibt(line(3), {{1}, {std::vector<Vertex>{1, 2}}}, 1, 1);

  EXPECT_EQ(run.goals, 2U);
}

TEST(PibtBound, NoTwoAreAtOneVertexOrSwap) {
  const StepGraph graph = square(8);

  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::mt19937_64 random(seed);
    PibtFleet fleet;
    for (Vertex i = 0; i < 40; ++i) {
      fleet.starts.push_back(i);
      fleet.goals.emplace_back();
      for (int goal = 0; goal < 30; ++goal) fleet.goals.back().push_back(static_cast<Vertex>(random() % 64));
    }

    std::vector<Vertex> before = fleet.starts;
    const PibtRun run = run_pibt(graph, fleet, 200, seed, [&](const std::vector<Vertex>& now) {
      expect_good_step(graph, before, now);
      before = now;
    });
    EXPECT_GT(run.goals, 100U);
  }
}

TEST(PibtBound, TheSameSeedGivesTheSameRun) {
  const StepGraph graph = square(5);
  const PibtFleet fleet{{0, 1, 2},
                        {std::vector<Vertex>{24, 0}, std::vector<Vertex>{20, 4}, std::vector<Vertex>{2, 22}}};
  std::vector<std::vector<Vertex>> a, b;
  run_pibt(graph, fleet, 30, 7, [&](const std::vector<Vertex>& now) { a.push_back(now); });
  run_pibt(graph, fleet, 30, 7, [&](const std::vector<Vertex>& now) { b.push_back(now); });

  EXPECT_EQ(a, b);
}

TEST(PibtBound, RateCountsStepsAndThePause) {
  EXPECT_DOUBLE_EQ(goals_per_vehicle_hour(20.0, 1.25, 0.5), 3600.0 / 25.5);
  EXPECT_DOUBLE_EQ(goals_per_vehicle_hour(PibtRun{0, 10}.steps_a_goal(1), 1.0, 0.5), 0.0);
}

TEST(PibtStep, RefusesPrescribedMovesThatDoNotGoTogether) {
  const StepGraph graph = line(3);
  PibtStep pibt(graph, 1);
  const StepTable to_2 = steps_to(graph, 2);
  const std::vector<const StepTable*> to_go{&to_2, &to_2};
  const auto plan = [&](std::vector<Vertex> next) { return pibt.plan({0, 1}, {0, 1}, to_go, next); };

  EXPECT_FALSE(plan({1, 0})) << "they would swap";
  EXPECT_FALSE(plan({1, 1})) << "both at one vertex";
  EXPECT_FALSE(plan({kNoVertex, 0})) << "the first one can neither stay nor swap";
  EXPECT_TRUE(plan({1, kNoVertex}));
  EXPECT_TRUE(plan({kNoVertex, kNoVertex}));
}

}  // namespace
}  // namespace aisle::lab
