// WU: the path is followed while no collision is predicted.
#include "services/local-planner/core/printed/path_following.hpp"

#include <gtest/gtest.h>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

kinematics::Limits limits() {
  kinematics::Limits limits;
  limits.max_speed_mps = 1.0;
  limits.max_turn_radps = 0.35;
  return limits;
}

TEST(PathFollowing, GoesStraightAtFullSpeedToAPointAhead) {
  const Twist2 twist = follow_path({1.0, 1.0, 0.0}, {2.0, 1.0}, limits());
  EXPECT_DOUBLE_EQ(twist.linear_mps, 1.0);
  EXPECT_DOUBLE_EQ(twist.angular_radps, 0.0);
}

TEST(PathFollowing, DrivesAnArcThatPassesThroughThePoint) {
  const geometry::Pose2 base{1.0, 1.0, 0.4};
  const geometry::Point2 ahead = geometry::to_map(base, {0.8, 0.3});
  const Twist2 twist = follow_path(base, ahead, limits());
  EXPECT_LE(twist.angular_radps, 0.35 + 1e-9);
  double least_m = 1e9;
  for (double t_s = 0.0; t_s < 5.0; t_s += 0.01)
    least_m = std::min(least_m, geometry::distance(kinematics::advance(base, twist, t_s).position(), ahead));
  EXPECT_LT(least_m, 0.01);
}

TEST(PathFollowing, IsSlowerInATightArcThanItsTurnRateAllows) {
  const Twist2 twist = follow_path({0.0, 0.0, 0.0}, {0.3, 0.5}, limits());
  EXPECT_LT(twist.linear_mps, 0.2);
  EXPECT_NEAR(twist.angular_radps, 0.35, 1e-9);
}

TEST(PathFollowing, TurnsToAPointBehind) {
  const Twist2 right = follow_path({0.0, 0.0, 0.0}, {-0.5, -0.1}, limits());
  EXPECT_GT(right.linear_mps, 0.0);
  EXPECT_NEAR(right.angular_radps, -0.35, 1e-9);
  EXPECT_EQ(follow_path({0.0, 0.0, 0.0}, {0.0, 0.0}, limits()).linear_mps, 0.0);
}

}  // namespace
}  // namespace aisle::local_planner
