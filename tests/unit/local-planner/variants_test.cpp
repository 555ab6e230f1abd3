// What every local planner must keep to, whatever its critics: this suite runs over all files in core/variants.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "services/local-planner/core/dwa.hpp"
#include "tests/unit/local-planner/drive.hpp"
#include "tests/unit/local-planner/hall.hpp"
#include "tests/unit/local-planner/samples.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;

class AnyVariant : public testing::TestWithParam<std::string> {
 protected:
  const Variant& variant() const { return *find_variant(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, AnyVariant, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Variant& variant : all_variants()) names.push_back(variant.name);
                           return names;
                         }()),
                         [](const auto& name) { return name.param; });

TEST(Variants, AreThoseOfThePapers) {
  std::vector<std::string> names;
  for (const Variant& variant : all_variants()) names.push_back(variant.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"dwa", "li", "qu", "wang", "wu", "yu"}));
  EXPECT_EQ(find_variant("weng"), nullptr);
  EXPECT_NE(variant_names().find("wang"), std::string::npos);
}

// L0 to L5 of the papers, in the order C1 to C8.
TEST(Variants, HaveTheWeightsOfTheirPapers) {
  const std::vector<Critic> critics{
      heading_critic,       clearance_critic,           velocity_critic,         sub_target_heading_critic,
      path_distance_critic, sub_target_distance_critic, static_clearance_critic, dynamic_clearance_critic};
  const std::map<std::string, std::vector<double>> weights{
      {"dwa", {.2, .5, .3, 0, 0, 0, 0, 0}},    {"li", {.05, .2, .3, .1, 0, 0, 0, 0}},
      {"wu", {.2, .15, .3, 0, .2, .15, 0, 0}}, {"qu", {.2, 0, .3, 0, 0, 0, .1, .4}},
      {"yu", {.05, .2, .5, 0, 0, 0, 0, 0}},    {"wang", {.05, .2, .3, 0, 0, 0, 0, 0}},
  };
  for (const auto& [name, expected] : weights) {
    std::vector<double> found(critics.size(), 0.0);
    for (const WeightedCritic& weighted : find_variant(name)->critics)
      found[static_cast<std::size_t>(std::distance(
          critics.begin(), std::find(critics.begin(), critics.end(), weighted.critic)))] += weighted.weight;
    EXPECT_EQ(found, expected) << name;
  }
}

TEST(Variants, HaveTheLimitsOfTheirPapers) {
  const PaperLimits wu = find_variant("wu")->paper, qu = find_variant("qu")->paper, yu = find_variant("yu")->paper,
                    wang = find_variant("wang")->paper;
  EXPECT_EQ(std::tuple(wu.max_speed_mps, wu.max_turn_radps, wu.max_acceleration_mps2, wu.max_turn_acceleration_radps2,
                       wu.horizon_s),
            std::tuple(1.0, 0.35, 0.2, 0.9, 3.0));
  EXPECT_EQ(std::tuple(qu.max_speed_mps, qu.max_turn_radps, qu.max_acceleration_mps2, qu.max_turn_acceleration_radps2),
            std::tuple(2.0, from_degrees(40.0), 0.4, from_degrees(60.0)));
  EXPECT_EQ(std::tuple(yu.max_speed_mps, yu.max_turn_radps, yu.max_turn_acceleration_radps2, yu.horizon_s),
            std::tuple(2.0, from_degrees(20.0), from_degrees(50.0), 3.0));
  EXPECT_EQ(std::tuple(wang.max_speed_mps, wang.max_turn_radps, wang.max_acceleration_mps2,
                       wang.max_turn_acceleration_radps2, wang.horizon_s),
            std::tuple(1.5, from_degrees(40.0), 1.0, from_degrees(50.0), 2.0));
}

TEST_P(AnyVariant, HasWeightedCriticsAndTheLimitsOfItsPaper) {
  ASSERT_FALSE(variant().critics.empty());
  for (const WeightedCritic& critic : variant().critics) EXPECT_GT(critic.weight, 0.0);
  EXPECT_FALSE(variant().summary.empty());
  EXPECT_GT(variant().paper.max_speed_mps, 0.0);
  EXPECT_GT(variant().paper.max_deceleration_mps2, 0.0) << "WU prints 0";
  EXPECT_LT(variant().paper.max_turn_radps, 4.0) << "YU and WANG print degrees as radians";
}

TEST_P(AnyVariant, ScoresWithFiniteNumbersFromZeroOn) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-20.0, 20.0), gap(-0.5, 0.6), yaw(-3.1, 3.1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Sample<double>> samples(kBlock);
    for (Sample<double>& sample : samples) {
      sample.linear_mps = std::abs(gap(random)), sample.angular_radps = yaw(random);
      sample.look_x_m = place(random), sample.look_y_m = place(random), sample.look_yaw_rad = yaw(random);
      sample.end_x_m = place(random), sample.end_y_m = place(random);
      sample.wall_gap_m = gap(random), sample.mover_gap_m = gap(random);
      sample.standing_gap_m = gap(random), sample.moving_gap_m = gap(random);
      sample.path_distance_m = std::abs(place(random));
    }
    Aim aim;
    aim.target_in_map = {place(random), place(random)};
    aim.sub_target_in_map = {place(random), place(random)};
    for (const WeightedCritic& weighted : variant().critics) {
      PerSample scores;
      weighted.critic.score_block(block_of(samples), aim, scores);
      for (std::size_t i = 0; i < kBlock; ++i) {
        EXPECT_TRUE(std::isfinite(scores[i]) && scores[i] >= 0.0) << scores[i];
        EXPECT_EQ(scores[i], weighted.critic.score(samples[i], aim)) << "four at once are scored as each alone";
      }
    }
  }
}

TEST_P(AnyVariant, NeverTakesASpeedThatCannotBeStopped) {
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0.5, 11.5), angle(-3.1, 3.1), unit(0.0, 1.0);
  for (int i = 0; i < 12; ++i) {
    const double x = place(random), y = place(random);
    block(grid, x, y, x + 0.6, y + 0.6);
  }
  const grid::ClearanceField clearance(grid);
  int chosen = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose2 base{place(random), place(random), angle(random)};
    if (clearance.clearance_m(base.position()) < 0.4) continue;
    Mover person;
    person.position_in_map = {place(random), place(random)};
    person.velocity_in_map = {2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0};
    const std::vector<Mover> movers{person};
    const std::vector<PeerMotion> peers;
    const Scene scene{clearance, base, {1.2 * unit(random), 2.4 * unit(random) - 1.2, 0.0}, 0.35, {}, 1.2,
                      movers,    peers};
    Aim aim;
    aim.target_in_map = aim.sub_target_in_map = {place(random), place(random)};
    aim.path_in_map = {base.position(), aim.target_in_map};
    const Choice choice = choose(scene, aim, variant(), {});
    if (!choice.found) continue;
    ++chosen;
    EXPECT_EQ(obstruction(scene, choice.twist, {}), Obstruction::kNone) << i;
  }
  EXPECT_GT(chosen, 60);
}

TEST_P(AnyVariant, ReachesAGoalAndStaysThere) {
  Drive drive(hall(20.0, 10.0), {3.0, 5.0, 1.0}, variant());
  drive.give_plan({{3.0, 5.0}, {10.0, 5.0}, {16.0, 7.0}});
  ASSERT_TRUE(drive.until(60.0, Phase::kArrived))
      << name(drive.output.phase) << " at " << drive.base.x << ", " << drive.base.y;
  EXPECT_LT(geometry::distance(drive.base.position(), {16.0, 7.0}), 0.15);
}

TEST_P(AnyVariant, StopsBeforeAWallOfThings) {
  Drive drive(aisle(1.4), {2.0, 5.0, 0.0}, variant());
  drive.give_plan({{2.0, 5.0}, {18.0, 5.0}});
  double least = 1e9;
  drive.until(20.0, [&] {
    drive.inputs.tracks = {drive.track({10.0, 5.0}, {}, true)};
    least = std::min(least, geometry::distance(drive.base.position(), {10.0, 5.0}) - 0.35 - 0.25);
    return false;
  });
  EXPECT_GT(least, 0.0);
  EXPECT_LT(drive.base.x, 9.5);
}

TEST_P(AnyVariant, StandsBeforeAPersonTouchesIt) {
  Drive drive(aisle(1.4), {2.0, 5.0, 0.0}, variant());
  drive.give_plan({{2.0, 5.0}, {18.0, 5.0}});
  double fastest = 0.0;
  double x = 16.0;
  drive.until(20.0, [&] {
    x -= 0.02 * 1.3;
    drive.inputs.tracks = {drive.track({x, 5.0}, {-1.3, 0.0}, false)};
    const double gap = geometry::distance(drive.base.position(), {x, 5.0}) - 0.6;
    if (gap < 0.02) fastest = std::max(fastest, std::abs(drive.twist.linear_mps));
    return gap < -0.3;
  });
  EXPECT_LT(fastest, 0.05);
}

TEST_P(AnyVariant, DoesTheSameTwice) {
  const auto trace = [&] {
    Drive drive(aisle(3.0), {2.0, 5.0, 0.3}, variant());
    drive.give_plan({{2.0, 5.0}, {18.0, 5.5}});
    std::vector<double> values;
    drive.until(10.0, [&] {
      values.push_back(drive.base.x);
      values.push_back(drive.base.yaw);
      return false;
    });
    return values;
  };
  EXPECT_EQ(trace(), trace());
}

TEST(Variants, TheTraditionalOneKnowsNoPath) {
  // A wall between: whoever follows the plan goes around, whoever drives straight at the goal stands before it.
  grid::OccupancyGrid grid = hall(20.0, 10.0);
  block(grid, 9.8, 2.0, 10.2, 10.0);
  const std::vector<Point2> around{{4.0, 7.0}, {9.0, 1.2}, {11.0, 1.2}, {16.0, 7.0}};
  for (const char* name : {"wang", "li", "wu", "qu", "yu"}) {
    Drive drive(grid, {4.0, 7.0, 0.0}, *find_variant(name));
    drive.give_plan(around);
    EXPECT_TRUE(drive.until(90.0, Phase::kArrived)) << name;
  }
  Drive straight(grid, {4.0, 7.0, 0.0}, *find_variant("dwa"));
  straight.give_plan(around);
  EXPECT_FALSE(straight.until(60.0, Phase::kArrived));
  EXPECT_LT(straight.base.x, 9.8);
}

}  // namespace
}  // namespace aisle::local_planner
