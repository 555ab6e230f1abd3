// Vehicles that cannot turn on the spot, and paths that keep away from racks.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "services/global-planner/core/dubins.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/path_figures.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/random_grid.hpp"

namespace aisle::global_planner {
namespace {

using geometry::kPi;
using geometry::Point2;
using geometry::Pose2;

TEST(Dubins, KnowsWaysThatAreKnown) {
  EXPECT_NEAR(shortest_dubins({0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, 1.0).length_m, 5.0, 1e-9);
  EXPECT_NEAR(shortest_dubins({0.0, 0.0, 0.0}, {0.0, 4.0, kPi}, 2.0).length_m, 2.0 * kPi, 1e-9);
  EXPECT_NEAR(shortest_dubins({0.0, 0.0, 0.0}, {0.0, -4.0, kPi}, 2.0).length_m, 2.0 * kPi, 1e-9);
  EXPECT_NEAR(shortest_dubins({0.0, 0.0, 0.0}, {0.0, 0.0, kPi}, 1.0).length_m, 7.0 / 3.0 * kPi, 1e-9)
      << "turning about: right, left, right";
}

/// Where a way of these pieces ends: turns of radius 2 with their lengths in radians, straights in metres.
Pose2 driven(std::initializer_list<std::pair<char, double>> pieces) {
  Pose2 pose{1.0, -2.0, 0.7};
  for (const auto& [turn, length] : pieces) {
    pose = turn == 'S' ? along_arc(pose, 0.0, length) : along_arc(pose, turn == 'L' ? 0.5 : -0.5, 2.0 * length);
  }
  return pose;
}

TEST(Dubins, ChangesLanesWithoutSymmetry) {
  // Each is the shortest way there by far; the first arc is not the last one turned round, so no other word makes up
  // for it.
  const Pose2 from{1.0, -2.0, 0.7};
  const DubinsPath left = shortest_dubins(from, driven({{'L', 0.9}, {'S', 6.0}, {'R', 0.4}}), 2.0);
  EXPECT_NEAR(left.length_m, 2.0 * 0.9 + 6.0 + 2.0 * 0.4, 1e-9) << "left, straight, right";
  EXPECT_GT(left.pieces[0].turn, 0.0);
  EXPECT_EQ(left.pieces[1].turn, 0.0);
  EXPECT_LT(left.pieces[2].turn, 0.0);
  const DubinsPath right = shortest_dubins(from, driven({{'R', 0.5}, {'S', 5.0}, {'L', 1.1}}), 2.0);
  EXPECT_NEAR(right.length_m, 2.0 * 0.5 + 5.0 + 2.0 * 1.1, 1e-9) << "right, straight, left";
  EXPECT_LT(right.pieces[0].turn, 0.0);
  EXPECT_EQ(right.pieces[1].turn, 0.0);
  EXPECT_GT(right.pieces[2].turn, 0.0);
  EXPECT_NEAR(shortest_dubins(from, driven({{'L', 0.8}, {'S', 4.0}, {'L', 0.3}}), 2.0).length_m,
              2.0 * 0.8 + 4.0 + 2.0 * 0.3, 1e-9)
      << "left, straight, left";
  EXPECT_NEAR(shortest_dubins(from, driven({{'R', 0.2}, {'S', 4.0}, {'R', 0.6}}), 2.0).length_m,
              2.0 * 0.2 + 4.0 + 2.0 * 0.6, 1e-9)
      << "right, straight, right";
}

TEST(Dubins, ArrivesAndIsTheSameBackwards) {
  std::mt19937 random(3);
  const auto pick = [&] { return 0.01 * test_support::random_between(random, -600, 600); };
  for (int i = 0; i < 2000; ++i) {
    const Pose2 from{pick(), pick(), geometry::wrap(pick())};
    const Pose2 to{pick(), pick(), geometry::wrap(pick())};
    const DubinsPath path = shortest_dubins(from, to, 0.8);
    ASSERT_TRUE(std::isfinite(path.length_m)) << i;
    const Pose2 end = path.pose_at(path.length_m);
    EXPECT_LT(geometry::distance(end.position(), to.position()), 1e-5);
    EXPECT_LT(std::abs(geometry::wrap(end.yaw - to.yaw)), 1e-5);
    EXPECT_GE(path.length_m, geometry::distance(from.position(), to.position()) - 1e-9);
    const DubinsPath back = shortest_dubins({to.x, to.y, geometry::wrap(to.yaw + kPi)},
                                            {from.x, from.y, geometry::wrap(from.yaw + kPi)}, 0.8);
    EXPECT_NEAR(back.length_m, path.length_m, 1e-5);
  }
}

/// Empty when a vehicle with this turning radius can drive the plan as its headings say; else what is wrong.
std::string why_not_steerable(const Problem& problem, const PlannedPath& plan) {
  if (plan.headings_rad.size() != plan.waypoints_in_map.size()) return "no heading for each point";
  if (std::abs(geometry::wrap(plan.headings_rad.front() - problem.steering.start_yaw_rad)) > 1e-6)
    return "wrong heading at the start";
  if (problem.steering.goal_yaw_rad &&
      std::abs(geometry::wrap(plan.headings_rad.back() - *problem.steering.goal_yaw_rad)) > 1e-5)
    return "wrong heading at the goal";
  for (std::size_t i = 1; i < plan.headings_rad.size(); ++i) {
    const Point2 step = plan.waypoints_in_map[i] - plan.waypoints_in_map[i - 1];
    const double turned = geometry::wrap(plan.headings_rad[i] - plan.headings_rad[i - 1]);
    if (std::abs(turned) * problem.steering.turning_radius_m > 1.01 * geometry::norm(step) + 1e-6)
      return "turns too tightly at point " + std::to_string(i);
    const double middle = plan.headings_rad[i - 1] + 0.5 * turned;
    if (std::abs(step.x * std::sin(middle) - step.y * std::cos(middle)) > 1e-4)
      return "slides sideways at point " + std::to_string(i);
  }
  return why_not_drivable(problem, plan.waypoints_in_map);
}

bool drives_backwards(const PlannedPath& plan) {
  for (std::size_t i = 1; i < plan.headings_rad.size(); ++i) {
    const Point2 step = plan.waypoints_in_map[i] - plan.waypoints_in_map[i - 1];
    if (step.x * std::cos(plan.headings_rad[i]) + step.y * std::sin(plan.headings_rad[i]) < -1e-6) return true;
  }
  return false;
}

TEST(Hybrid, TurnsNoTighterThanTheVehicleCan) {
  const auto planner = find_variant("hybrid")->make();
  int found = 0;
  for (unsigned seed = 1; seed <= 15; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(test_support::random_blocks(random, 100, 8, 15, 0.1), 2.0);
    Problem problem{clearance, {0.81, 0.83}, {9.2, 9.17}, 0.3};
    problem.steering = {0.8, 0.5, seed % 2 == 0 ? std::optional<double>(-2.0) : std::nullopt};
    const PlannedPath plan = planner->plan(problem, nullptr);
    if (plan.outcome != Outcome::kFound) continue;
    ++found;
    EXPECT_EQ(why_not_steerable(problem, plan), "") << "seed " << seed;
  }
  EXPECT_GE(found, 8);
}

TEST(Hybrid, BacksOutOfADeadEndTooNarrowToTurnIn) {
  // An aisle 2 m wide, closed at its left end; with a turning radius of 1 m and 0.3 m around it, the vehicle cannot
  // turn in one go.
  grid::OccupancyGrid grid(grid::Geometry{120, 80, 0.1, {}}, grid::Occupancy::kOccupied);
  for (int y = 30; y < 50; ++y) {
    for (int x = 0; x < 80; ++x) grid.set({x, y}, grid::Occupancy::kFree);
  }
  for (int y = 0; y < 80; ++y) {
    for (int x = 80; x < 120; ++x) grid.set({x, y}, grid::Occupancy::kFree);
  }
  const grid::ClearanceField clearance(grid, 2.0);
  Problem problem{clearance, {2.05, 4.05}, {6.05, 4.05}, 0.3};
  problem.steering = {1.0, kPi, 0.0};
  const PlannedPath plan = find_variant("hybrid")->make()->plan(problem, nullptr);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(why_not_steerable(problem, plan), "");
  EXPECT_TRUE(drives_backwards(plan));
}

TEST(Clear, KeepsToTheMiddleOfAnAisle) {
  // An aisle 3 m wide with a bend; the shortest way hugs the inner corner.
  grid::OccupancyGrid grid(grid::Geometry{100, 100, 0.1, {}}, grid::Occupancy::kOccupied);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (x < 30 || y >= 70) grid.set({x, y}, grid::Occupancy::kFree);
    }
  }
  const grid::ClearanceField clearance(grid, 3.0);
  Problem problem{clearance, {1.55, 1.55}, {8.45, 8.55}, 0.3};
  problem.preferred_clearance_m = 1.2;
  const PlannedPath clear = find_variant("clear")->make()->plan(problem, nullptr);
  const PlannedPath astar = find_variant("astar")->make()->plan(problem, nullptr);
  ASSERT_EQ(clear.outcome, Outcome::kFound);
  EXPECT_EQ(why_not_drivable(problem, clear.waypoints_in_map), "");
  EXPECT_LT(path_figures(clearance, astar.waypoints_in_map).least_clearance_m, 0.5);
  EXPECT_GT(path_figures(clearance, clear.waypoints_in_map).least_clearance_m, 0.8);
  EXPECT_LT(clear.length_m, 1.3 * astar.length_m);
}

}  // namespace
}  // namespace aisle::global_planner
