#include "common/kinematics/omnidirectional.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::kinematics {
namespace {

using geometry::Pose2;
using geometry::Twist2;

Limits limits() {
  Limits out;
  out.model = Model::kOmnidirectional;
  return out;
}

double speed_of(const Twist2& twist) { return std::hypot(twist.linear_mps, twist.sideways_mps); }

TEST(Omnidirectional, TheSpeedLimitHoldsInEveryDirection) {
  for (double angle = 0.0; angle < 1.5; angle += 0.1) {
    const Twist2 twist = limit_change({}, {3.0 * std::cos(angle), 0.0, 3.0 * std::sin(angle)}, limits(), 100.0);
    EXPECT_NEAR(speed_of(twist), limits().max_speed_mps, 1e-12);
    EXPECT_NEAR(std::atan2(twist.sideways_mps, twist.linear_mps), angle, 1e-12);
  }
  EXPECT_DOUBLE_EQ(limit_change({}, {-9.0, 0.0, 0.0}, limits(), 100.0).linear_mps, -limits().max_reverse_mps);
}

TEST(Omnidirectional, NoChangeIsGreaterThanTheLimits) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  for (int i = 0; i < 1000; ++i) {
    const Twist2 now = limit_change({}, {any(random), any(random), any(random)}, limits(), 100.0);
    const Twist2 next = limit_change(now, {any(random), any(random), any(random)}, limits(), 0.1);
    const double change = std::hypot(next.linear_mps - now.linear_mps, next.sideways_mps - now.sideways_mps);
    EXPECT_LE(change, 0.1 * limits().max_deceleration_mps2 + 1e-12);
    EXPECT_LE(speed_of(next) - speed_of(now), 0.1 * limits().max_acceleration_mps2 + 1e-12);
    EXPECT_LE(speed_of(next), limits().max_speed_mps + 1e-12);
  }
}

// The exact arc beside Euler steps of ten microseconds of LI eq. 4: x' = vx cos - vy sin, y' = vx sin + vy cos.
TEST(Omnidirectional, TheArcIsWhatFineIntegrationGives) {
  for (const Twist2 twist : {Twist2{0.8, 0.6, 0.4}, Twist2{-0.2, -1.1, 0.9}, Twist2{0.0, 0.0, -0.5}}) {
    Pose2 pose{1.0, -2.0, 0.3};
    const Pose2 arc = advance(pose, twist, 2.0);
    constexpr double kDt = 1e-5;
    for (int i = 0; i < 200000; ++i) {
      const double yaw = pose.yaw + 0.5 * kDt * twist.angular_radps;
      pose.x += kDt * (twist.linear_mps * std::cos(yaw) - twist.sideways_mps * std::sin(yaw));
      pose.y += kDt * (twist.linear_mps * std::sin(yaw) + twist.sideways_mps * std::cos(yaw));
      pose.yaw += kDt * twist.angular_radps;
    }
    EXPECT_NEAR(arc.x, pose.x, 1e-8);
    EXPECT_NEAR(arc.y, pose.y, 1e-8);
    EXPECT_NEAR(geometry::wrap(arc.yaw - pose.yaw), 0.0, 1e-8);
  }
}

}  // namespace
}  // namespace aisle::kinematics
