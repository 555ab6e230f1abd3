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

}  // namespace
}  // namespace aisle::local_planner
