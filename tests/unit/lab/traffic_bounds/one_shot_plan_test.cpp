#include "tools/lab/traffic_bounds/one_shot_plan.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/lab/traffic_bounds/graphs.hpp"

namespace aisle::lab {
namespace {

void expect_good_plan(const StepGraph& graph, const OneShotPlan& plan, const std::vector<Vertex>& starts,
                      const std::vector<Vertex>& goals) {
  const std::size_t steps = plan.paths.front().size();
  std::uint64_t cost = 0;

  for (std::size_t i = 0; i < starts.size(); ++i) {
    ASSERT_EQ(plan.paths[i].size(), steps);
    EXPECT_EQ(plan.paths[i].front(), starts[i]);
    EXPECT_EQ(plan.paths[i].back(), goals[i]);

    std::size_t end = steps - 1;
    while (end > 0 && plan.paths[i][end - 1] == goals[i]) --end;
    cost += end;
  }

  EXPECT_EQ(plan.cost, cost);
  EXPECT_GE(plan.cost, plan.least_cost);

  const auto at = [&](std::size_t step) {
    std::vector<Vertex> all;
    for (const auto& path : plan.paths) all.push_back(path[step]);
    return all;
  };
  for (std::size_t step = 0; step + 1 < steps; ++step) expect_good_step(graph, at(step), at(step + 1));
}

TEST(OneShotPlan, OfOneVehicleIsItsShortestWay) {
  const StepGraph graph = line(6);
  const auto plan = plan_one_shot(graph, {1}, {5}, 1);

  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->cost, 4U);
  EXPECT_EQ(plan->least_cost, 4U);
  EXPECT_DOUBLE_EQ(plan->stretch(), 1.0);
}

// One of them drives into the pocket and out again.
TEST(OneShotPlan, TwoSwapOverAPocket) {
  const StepGraph graph = graph_of(4, {{0, 1}, {1, 2}, {1, 3}});
  const auto plan = plan_one_shot(graph, {0, 2}, {2, 0}, 1);

  ASSERT_TRUE(plan);
  expect_good_plan(graph, *plan, {0, 2}, {2, 0});
  EXPECT_EQ(plan->least_cost, 4U);
  EXPECT_GE(plan->cost, 7U) << "3 for the one that drives through, 4 for the one that lets it pass";
}

TEST(OneShotPlan, TwoThatCannotPassHaveNone) { EXPECT_FALSE(plan_one_shot(line(3), {0, 2}, {2, 0}, 1)); }

TEST(OneShotPlan, ImprovementKeepsThePlanGoodAndShortensIt) {
  const StepGraph graph = square(8);

  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::mt19937_64 random(seed);
    std::vector<Vertex> goals;
    std::vector<Vertex> starts;
    for (Vertex v = 0; v < 64; ++v) goals.push_back(v);
    for (std::size_t i = goals.size(); i > 1; --i) std::swap(goals[i - 1], goals[random() % i]);
    goals.resize(24);
    for (Vertex v = 0; v < 24; ++v) starts.push_back(v);

    const auto first = plan_one_shot(graph, starts, goals, seed, {20'000, 0});
    const auto better = plan_one_shot(graph, starts, goals, seed, {20'000, 300});
    ASSERT_TRUE(first && better) << seed;
    expect_good_plan(graph, *first, starts, goals);
    expect_good_plan(graph, *better, starts, goals);
    EXPECT_LT(better->cost, first->cost);
    EXPECT_EQ(plan_one_shot(graph, starts, goals, seed, {20'000, 300})->paths, better->paths);
  }
}

}  // namespace
}  // namespace aisle::lab
