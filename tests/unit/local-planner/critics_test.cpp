#include <gtest/gtest.h>

#include "services/local-planner/core/critic.hpp"
#include "tests/unit/local-planner/samples.hpp"

namespace aisle::local_planner {
namespace {

Sample<double> facing(double yaw_rad) {
  Sample<double> samples = blank_sample();
  samples.look_yaw_rad = yaw_rad;
  return samples;
}

TEST(Critics, HeadingIsBestTowardsTheTarget) {
  Aim aim;
  aim.target_in_map = {0.0, 2.0};
  EXPECT_NEAR(score_of(heading_critic, facing(geometry::kPi / 2), aim), geometry::kPi, 1e-12);
  EXPECT_NEAR(score_of(heading_critic, facing(-geometry::kPi / 2), aim), 0.0, 1e-12);
  EXPECT_GT(score_of(heading_critic, facing(1.0), aim), score_of(heading_critic, facing(0.5), aim));
  EXPECT_NEAR(score_of(heading_critic, facing(3.0), aim), score_of(heading_critic, facing(geometry::kPi - 3.0), aim),
              1e-12);  // across +-pi
}

TEST(Critics, ClearanceTakesTheWorseAndStopsAtItsCap) {
  Aim aim;
  Sample<double> sample = blank_sample();
  sample.wall_gap_m = 0.5 * aim.wall_cap_m;
  sample.mover_gap_m = 99.0;
  EXPECT_DOUBLE_EQ(score_of(clearance_critic, sample, aim), 0.5);
  sample.mover_gap_m = 0.25 * aim.mover_cap_m;
  EXPECT_DOUBLE_EQ(score_of(clearance_critic, sample, aim), 0.25);
  sample.wall_gap_m = 99.0, sample.mover_gap_m = 99.0;
  EXPECT_DOUBLE_EQ(score_of(clearance_critic, sample, aim), 1.0);
  sample.mover_gap_m = -0.1;
  EXPECT_DOUBLE_EQ(score_of(clearance_critic, sample, aim), 0.0);
}

TEST(Critics, FasterIsBetter) {
  Sample<double> slow = blank_sample();
  Sample<double> fast = blank_sample();
  slow.linear_mps = 0.2;
  fast.linear_mps = 0.8;
  EXPECT_GT(score_of(velocity_critic, fast, {}), score_of(velocity_critic, slow, {}));
}

TEST(Critics, AreNeverNegative) {
  Sample<double> worst = blank_sample();
  worst.wall_gap_m = -1.0;
  worst.mover_gap_m = -1.0;
  worst.linear_mps = -0.3;
  for (const WeightedCritic& critic : wang().critics) EXPECT_GE(score_of(critic.critic, worst, {}), 0.0);
}

TEST(Critics, SubTargetHeadingLooksAtThePathAndNotAtTheTarget) {
  Sample<double> sample = blank_sample();
  sample.look_x_m = 0.0;
  Aim aim;
  aim.target_in_map = {-1.0, 0.0};
  aim.sub_target_in_map = {1.0, 0.0};
  EXPECT_NEAR(score_of(sub_target_heading_critic, sample, aim), geometry::kPi, 1e-12);
  aim.sub_target_in_map = {0.0, 1.0};
  EXPECT_NEAR(score_of(sub_target_heading_critic, sample, aim), geometry::kPi / 2, 1e-12);
}

TEST(Critics, PathDistanceIsARewardForNearness) {
  Sample<double> on = blank_sample(), off = blank_sample(), far = blank_sample();
  off.path_distance_m = 0.4;
  far.path_distance_m = 7.0;
  EXPECT_DOUBLE_EQ(score_of(path_distance_critic, on, {}), 1.0);
  EXPECT_LT(score_of(path_distance_critic, off, {}), score_of(path_distance_critic, on, {}));
  EXPECT_DOUBLE_EQ(score_of(path_distance_critic, far, {}), 0.0);
}

TEST(Critics, SubTargetDistanceFallsWithTheDistance) {
  Sample<double> near = blank_sample(), far = blank_sample();
  Aim aim;
  aim.target_in_map = {1.0, 0.0};
  near.look_x_m = 0.8;
  far.look_x_m = -5.0;
  EXPECT_GT(score_of(sub_target_distance_critic, near, aim), 0.9);
  EXPECT_DOUBLE_EQ(score_of(sub_target_distance_critic, far, aim), 0.0);
}

TEST(Critics, StaticClearanceGrowsFromOnePointTwoRadiiOn) {
  Aim aim;
  Sample<double> close = blank_sample(), mid = blank_sample(), wide = blank_sample();
  close.wall_gap_m = 0.05;  // 0.40 m < 1.2 * 0.35 m
  for (Sample<double>* samples : {&close, &mid, &wide}) samples->standing_gap_m = 0.6;
  mid.wall_gap_m = 0.12;
  wide.wall_gap_m = 0.2;
  EXPECT_DOUBLE_EQ(score_of(static_clearance_critic, close, aim), 0.0);
  EXPECT_GT(score_of(static_clearance_critic, mid, aim), 0.0);
  EXPECT_GT(score_of(static_clearance_critic, wide, aim), score_of(static_clearance_critic, mid, aim));
  wide.standing_gap_m = 0.02;
  EXPECT_DOUBLE_EQ(score_of(static_clearance_critic, wide, aim), 0.0) << "things that stand count as walls do";
}

TEST(Critics, DynamicClearanceGrowsFromOnePointTwoStepsOn) {
  Aim aim;
  Sample<double> sample = blank_sample();
  sample.linear_mps = 1.0;
  sample.moving_gap_m = 0.11;  // < 1.2 * 1 m/s * 0.1 s
  EXPECT_DOUBLE_EQ(score_of(dynamic_clearance_critic, sample, aim), 0.0);
  sample.moving_gap_m = 0.3;
  const double mid = score_of(dynamic_clearance_critic, sample, aim);
  EXPECT_GT(mid, 0.0);
  sample.moving_gap_m = 0.5;
  EXPECT_GT(score_of(dynamic_clearance_critic, sample, aim), mid);
}

}  // namespace
}  // namespace aisle::local_planner
