#include "common/kinematics/vehicle_model.hpp"

#include <gtest/gtest.h>

namespace aisle::kinematics {
namespace {

using geometry::kPi;
using geometry::Pose2;
using geometry::Twist2;

TEST(Advance, DrivesStraightAlongTheHeading) {
  const Pose2 end = advance({1.0, 2.0, kPi / 2}, {0.5, 0.0, 0.0}, 2.0);
  EXPECT_NEAR(end.x, 1.0, 1e-12);
  EXPECT_NEAR(end.y, 3.0, 1e-12);
  EXPECT_NEAR(end.yaw, kPi / 2, 1e-12);
}

TEST(Advance, AHalfCircleEndsOnItsDiameter) {
  const Pose2 end = advance({0.0, 0.0, 0.0}, {1.0, kPi / 2, 0.0}, 2.0);  // radius 2/pi
  EXPECT_NEAR(end.x, 0.0, 1e-12);
  EXPECT_NEAR(end.y, 4.0 / kPi, 1e-12);
  EXPECT_NEAR(end.yaw, kPi, 1e-12);
}

TEST(Advance, OneLongStepEqualsManyShortOnes) {
  for (const Twist2 twist :
       {Twist2{0.7, -0.9, 0.0}, Twist2{-0.4, 0.3, 0.2}, Twist2{0.3, 1e-8, -0.5}, Twist2{0.0, 1.2, 0.0}}) {
    const Pose2 start{3.0, -1.0, 2.8};
    Pose2 stepped = start;
    for (int i = 0; i < 1000; ++i) stepped = advance(stepped, twist, 0.002);
    const Pose2 once = advance(start, twist, 2.0);
    EXPECT_NEAR(once.x, stepped.x, 1e-9);
    EXPECT_NEAR(once.y, stepped.y, 1e-9);
    EXPECT_NEAR(geometry::wrap(once.yaw - stepped.yaw), 0.0, 1e-9);
  }
}

TEST(Advance, BackwardsUndoesForwards) {
  const Pose2 start{0.5, 0.5, 1.0};
  const Pose2 back = advance(advance(start, {0.8, 0.6, 0.1}, 1.5), {0.8, 0.6, 0.1}, -1.5);
  EXPECT_NEAR(back.x, start.x, 1e-12);
  EXPECT_NEAR(back.y, start.y, 1e-12);
}

TEST(LimitChange, SpeedsUpAndSlowsDownAtDifferentRates) {
  const Limits limits;
  EXPECT_NEAR(limit_change({0.5, 0, 0}, {1.2, 0, 0}, limits, 0.1).linear_mps, 0.5 + 0.08, 1e-12);
  EXPECT_NEAR(limit_change({0.5, 0, 0}, {0.0, 0, 0}, limits, 0.1).linear_mps, 0.5 - 0.12, 1e-12);
  EXPECT_NEAR(limit_change({0, -1.0, 0}, {0, 1.0, 0}, limits, 0.1).angular_radps, -0.75, 1e-12);
}

TEST(LimitChange, ReachesWhatIsWithinReachExactly) {
  EXPECT_DOUBLE_EQ(limit_change({0.5, 0.1, 0}, {0.52, 0.2, 0}, Limits{}, 0.1).linear_mps, 0.52);
  EXPECT_DOUBLE_EQ(limit_change({0.5, 0.1, 0}, {0.52, 0.2, 0}, Limits{}, 0.1).angular_radps, 0.2);
}

TEST(LimitChange, BrakesFirstWhenTheDirectionTurnsRound) {
  const Limits limits;  // 0.06 m/s needs 0.05 s to a stand, the other 0.05 s accelerate backwards
  EXPECT_NEAR(limit_change({0.06, 0, 0}, {-0.3, 0, 0}, limits, 0.1).linear_mps, -0.04, 1e-12);
  EXPECT_NEAR(limit_change({1.0, 0, 0}, {-0.3, 0, 0}, limits, 0.1).linear_mps, 0.88, 1e-12);
}

TEST(LimitChange, KeepsToTheVehiclesOwnMaxima) {
  const Limits limits;
  const Twist2 fast = limit_change({}, {99, 99, 0}, limits, 1000.0);
  EXPECT_DOUBLE_EQ(fast.linear_mps, limits.max_speed_mps);
  EXPECT_DOUBLE_EQ(fast.angular_radps, limits.max_turn_radps);
  EXPECT_DOUBLE_EQ(limit_change({}, {-99, 0, 0}, limits, 1000.0).linear_mps, -limits.max_reverse_mps);
}

TEST(StoppingDistance, IsHalfTheSquareOfTheSpeedOverTheDeceleration) {
  EXPECT_DOUBLE_EQ(stopping_distance_m(1.2, 1.2), 0.6);
  EXPECT_DOUBLE_EQ(stopping_distance_m(-1.2, 1.2), 0.6);
}

}  // namespace
}  // namespace aisle::kinematics
