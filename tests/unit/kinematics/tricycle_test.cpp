#include "common/kinematics/tricycle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::kinematics {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

Limits forklift(bool is_rear = false) {
  Limits out;
  out.model = Model::kTricycle;
  out.axle.is_rear = is_rear;
  return out;
}

TEST(Tricycle, TheSteeredWheelRollsWhereItPoints) {
  for (const bool is_rear : {false, true}) {
    const SteeredAxle axle{1.5, 1.2, 0.8, is_rear};
    for (const double steering : {-1.1, -0.4, 0.0, 0.3, 1.2}) {
      const double v = 0.7;
      const double w = turn_rate_radps(axle, v, steering);
      const double wheel_x = is_rear ? -1.5 : 1.5;
      const Point2 of_wheel{v, w * wheel_x};  // velocity of the rigid body there, in its frame
      EXPECT_NEAR(std::atan2(of_wheel.y, of_wheel.x), steering, 1e-12);
      EXPECT_NEAR(steering_for_rad(axle, {v, w, 0.0}, 99.0), steering, 1e-12);
      EXPECT_NEAR(steering_for_rad(axle, {-v, -w, 0.0}, 99.0), steering, 1e-12) << "backwards along the same arc";
    }
  }
}

TEST(Tricycle, SteersLeftWithTheWheelToTheRightWhenItIsBehind) {
  EXPECT_GT(turn_rate_radps({1.5, 1.2, 0.8, false}, 1.0, 0.5), 0.0);
  EXPECT_LT(turn_rate_radps({1.5, 1.2, 0.8, true}, 1.0, 0.5), 0.0);
}

// Beside steps of ten microseconds in which the wheel is dragged over the floor: the fixed axle follows without
// slipping sideways.
TEST(Tricycle, TheArcIsWhatFineIntegrationOfBothAxlesGives) {
  const SteeredAxle axle{1.5, 1.2, 0.8, false};
  for (const double steering : {-1.0, 0.2, 0.9}) {
    const double v = 0.8;
    const Pose2 start{2.0, 1.0, -0.4};
    const Pose2 arc = advance(start, {v, turn_rate_radps(axle, v, steering), 0.0}, 2.0);
    Point2 fixed = start.position();
    Point2 wheel = geometry::to_map(start, {axle.wheelbase_m, 0.0});
    constexpr double kDt = 1e-5;
    for (int i = 0; i < 200000; ++i) {
      const double yaw = geometry::bearing(fixed, wheel);
      wheel = wheel + (kDt * v / std::cos(steering)) * Point2{std::cos(yaw + steering), std::sin(yaw + steering)};
      fixed = fixed + (kDt * v) * Point2{std::cos(yaw), std::sin(yaw)};
      const Point2 frame = fixed - wheel;  // the frame is stiff
      fixed = wheel + (axle.wheelbase_m / geometry::norm(frame)) * frame;
    }
    EXPECT_NEAR(arc.x, fixed.x, 1e-4);
    EXPECT_NEAR(arc.y, fixed.y, 1e-4);
    EXPECT_NEAR(geometry::wrap(arc.yaw - geometry::bearing(fixed, wheel)), 0.0, 1e-4);
  }
}

TEST(Tricycle, CannotTurnOnTheSpotNorTighterThanItsWheelAllows) {
  const Limits limits = forklift();
  DriveState state;
  for (int i = 0; i < 200; ++i) state = follow(state, {0.0, 1.0, 0.0}, limits, 0.02);
  EXPECT_EQ(state.twist.angular_radps, 0.0);
  EXPECT_EQ(state.twist.linear_mps, 0.0);
  for (int i = 0; i < 500; ++i) {
    state = follow(state, {0.4, 5.0, 0.0}, limits, 0.02);
    EXPECT_LE(std::abs(state.steering_rad), limits.axle.max_steering_rad + 1e-12);
    EXPECT_GE(state.twist.linear_mps + 1e-12, least_radius_m(limits.axle) * std::abs(state.twist.angular_radps));
  }
  EXPECT_NEAR(state.twist.linear_mps / state.twist.angular_radps, least_radius_m(limits.axle), 1e-9);
  EXPECT_NEAR(least_turning_radius_m(limits), 1.5 / std::tan(1.2), 1e-12);
  EXPECT_EQ(least_turning_radius_m(Limits{}), 0.0);
}

TEST(Tricycle, KeepsEveryLimitWhateverIsWanted) {
  for (const bool is_rear : {false, true}) {
    const Limits limits = forklift(is_rear);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-2.0, 2.0);
    DriveState state;
    for (int i = 0; i < 20000; ++i) {
      const Twist2 wanted{any(random), any(random), any(random)};
      for (int k = 0; k < 5; ++k) {
        const DriveState next = follow(state, wanted, limits, 0.02);
        EXPECT_LE(std::abs(next.steering_rad - state.steering_rad), 0.02 * limits.axle.max_steering_rate_radps + 1e-12);
        EXPECT_LE(std::abs(next.twist.linear_mps - state.twist.linear_mps),
                  0.02 * limits.max_deceleration_mps2 + 1e-12);
        EXPECT_LE(next.twist.linear_mps, limits.max_speed_mps);
        EXPECT_GE(next.twist.linear_mps, -limits.max_reverse_mps);
        EXPECT_EQ(next.twist.sideways_mps, 0.0);
        state = next;
      }
    }
  }
}

TEST(Tricycle, TheWheelStaysWhereItPointsWhileTheVehicleStands) {
  const Limits limits = forklift();
  const DriveState stood = follow({{}, 0.6}, {}, limits, 0.5);
  EXPECT_EQ(stood.steering_rad, 0.6);
  const DriveState begins = follow(stood, {0.5, 0.5 * std::tan(0.6) / 1.5, 0.0}, limits, 0.02);
  EXPECT_NEAR(begins.twist.angular_radps / begins.twist.linear_mps, std::tan(0.6) / 1.5, 1e-12);
}

}  // namespace
}  // namespace aisle::kinematics
