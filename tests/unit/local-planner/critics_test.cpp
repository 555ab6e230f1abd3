#include "services/local-planner/core/critic.hpp"

#include <gtest/gtest.h>

namespace aisle::local_planner {
namespace {

Sample facing(double yaw_rad) {
  Sample sample;
  sample.look_in_map = {0.0, 0.0, yaw_rad};
  return sample;
}

TEST(Critics, HeadingIsBestTowardsTheTarget) {
  Aim aim;
  aim.target_in_map = {0.0, 2.0};
  EXPECT_NEAR(heading_critic(facing(geometry::kPi / 2), aim), geometry::kPi, 1e-12);
  EXPECT_NEAR(heading_critic(facing(-geometry::kPi / 2), aim), 0.0, 1e-12);
  EXPECT_GT(heading_critic(facing(1.0), aim), heading_critic(facing(0.5), aim));
  EXPECT_NEAR(heading_critic(facing(3.0), aim), heading_critic(facing(geometry::kPi - 3.0), aim), 1e-12);    // across +-pi
}

TEST(Critics, ClearanceTakesTheWorseAndStopsAtItsCap) {
  Aim aim;
  Sample sample;
  sample.wall_gap_m = 0.5 * aim.wall_cap_m;
  sample.mover_gap_m = 99.0;
  EXPECT_DOUBLE_EQ(clearance_critic(sample, aim), 0.5);
  sample.mover_gap_m = 0.25 * aim.mover_cap_m;
  EXPECT_DOUBLE_EQ(clearance_critic(sample, aim), 0.25);
  sample.wall_gap_m = sample.mover_gap_m = 99.0;
  EXPECT_DOUBLE_EQ(clearance_critic(sample, aim), 1.0);
  sample.mover_gap_m = -0.1;
  EXPECT_DOUBLE_EQ(clearance_critic(sample, aim), 0.0);
}

TEST(Critics, FasterIsBetter) {
  Sample slow;
  Sample fast;
  slow.twist.linear_mps = 0.2;
  fast.twist.linear_mps = 0.8;
  EXPECT_GT(velocity_critic(fast, {}), velocity_critic(slow, {}));
}

TEST(Critics, AreNeverNegative) {
  Sample worst;
  worst.wall_gap_m = -1.0;
  worst.mover_gap_m = -1.0;
  worst.twist.linear_mps = -0.3;
  for (const WeightedCritic& critic : wang().critics) EXPECT_GE(critic.score(worst, {}), 0.0);
}

TEST(Critics, SubTargetHeadingLooksAtThePathAndNotAtTheTarget) {
  Sample sample;
  sample.look_in_map = {0.0, 0.0, 0.0};
  Aim aim;
  aim.target_in_map = {-1.0, 0.0};
  aim.sub_target_in_map = {1.0, 0.0};
  EXPECT_NEAR(sub_target_heading_critic(sample, aim), geometry::kPi, 1e-12);
  aim.sub_target_in_map = {0.0, 1.0};
  EXPECT_NEAR(sub_target_heading_critic(sample, aim), geometry::kPi / 2, 1e-12);
}

TEST(Critics, PathDistanceIsARewardForNearness) {
  Sample on, off, far;
  off.path_distance_m = 0.4;
  far.path_distance_m = 7.0;
  EXPECT_DOUBLE_EQ(path_distance_critic(on, {}), 1.0);
  EXPECT_LT(path_distance_critic(off, {}), path_distance_critic(on, {}));
  EXPECT_DOUBLE_EQ(path_distance_critic(far, {}), 0.0);
}

TEST(Critics, SubTargetDistanceFallsWithTheDistance) {
  Sample near, far;
  Aim aim;
  aim.target_in_map = {1.0, 0.0};
  near.look_in_map = {0.8, 0.0, 0.0};
  far.look_in_map = {-5.0, 0.0, 0.0};
  EXPECT_GT(sub_target_distance_critic(near, aim), 0.9);
  EXPECT_DOUBLE_EQ(sub_target_distance_critic(far, aim), 0.0);
}

TEST(Critics, StaticClearanceGrowsFromOnePointTwoRadiiOn) {
  Aim aim;
  Sample close, mid, wide;
  close.wall_gap_m = 0.05;                                  // 0.40 m < 1.2 * 0.35 m
  close.standing_gap_m = mid.standing_gap_m = wide.standing_gap_m = 0.6;
  mid.wall_gap_m = 0.12;
  wide.wall_gap_m = 0.2;
  EXPECT_DOUBLE_EQ(static_clearance_critic(close, aim), 0.0);
  EXPECT_GT(static_clearance_critic(mid, aim), 0.0);
  EXPECT_GT(static_clearance_critic(wide, aim), static_clearance_critic(mid, aim));
  wide.standing_gap_m = 0.02;
  EXPECT_DOUBLE_EQ(static_clearance_critic(wide, aim), 0.0) << "things that stand count as walls do";
}

TEST(Critics, DynamicClearanceGrowsFromOnePointTwoStepsOn) {
  Aim aim;
  Sample sample;
  sample.twist.linear_mps = 1.0;
  sample.moving_gap_m = 0.11;                               // < 1.2 * 1 m/s * 0.1 s
  EXPECT_DOUBLE_EQ(dynamic_clearance_critic(sample, aim), 0.0);
  sample.moving_gap_m = 0.3;
  const double mid = dynamic_clearance_critic(sample, aim);
  EXPECT_GT(mid, 0.0);
  sample.moving_gap_m = 0.5;
  EXPECT_GT(dynamic_clearance_critic(sample, aim), mid);
}

}  // namespace
}  // namespace aisle::local_planner
