// The twist in force, and where it takes the vehicle.
#include "services/local-planner/core/command_following.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class Following : public testing::Test {
 protected:
  /// So many control periods of wanting `twist`.
  void want(const geometry::Twist2& twist, int periods) {
    for (int i = 0; i < periods; ++i) follower.follow(twist, vehicle.limits);
  }
  time::Latest<Motion> state_of(double speed_mps, double arrived_s = 0.0) const {
    time::Latest<Motion> state;
    state.set({{3.0, 5.0, 0.0}, {speed_mps, 0.0, 0.0}}, at_s(arrived_s));
    return state;
  }

  Settings settings;
  Vehicle vehicle{"agv-1", geometry::disc(0.35), {}, 10.0, 0.2};
  CommandFollower follower{settings};
};

TEST_F(Following, NeverExceedsWhatTheVehicleCan) {
  want({1.0, 0.0, 0.0}, 1);
  EXPECT_NEAR(follower.in_force().linear_mps, vehicle.limits.max_acceleration_mps2 * settings.control_period_s, 1e-9);
  want({1.0, 0.0, 0.0}, 200);
  EXPECT_NEAR(follower.in_force().linear_mps, 1.0, 1e-9);
}

TEST_F(Following, CarriesTheStateOnToNowAndThenToWhenTheCommandActs) {
  want({1.0, 0.0, 0.0}, 200);
  const OwnMotion motion = follower.observe(vehicle, state_of(1.0), at_s(0.05));
  EXPECT_NEAR(motion.base_now.x, 3.05, 1e-9);
  EXPECT_NEAR(motion.base_then.x, 3.05 + settings.surroundings.dead_time_s, 1e-9);
  EXPECT_DOUBLE_EQ(motion.measured_mps, 1.0);
  EXPECT_FALSE(motion.stands());
}

TEST_F(Following, AnOldStateIsNotCarriedOnForEver) {
  const OwnMotion motion = follower.observe(vehicle, state_of(1.0), at_s(10.0));
  EXPECT_NEAR(motion.base_now.x, 3.0 + settings.stale_state_s, 1e-9);
}

TEST_F(Following, WithoutAStateThereIsNoMotion) {
  const OwnMotion motion = follower.observe(vehicle, {}, kStart);
  EXPECT_EQ(motion.base_now.position(), geometry::Point2{});
  EXPECT_TRUE(motion.stands());
}

TEST_F(Following, AVehicleThatStandsAgainstItsCommandsPullsThemBack) {
  want({1.0, 0.0, 0.0}, 200);
  follower.observe(vehicle, state_of(0.0), kStart);
  EXPECT_LT(follower.in_force().linear_mps, 0.5);
  EXPECT_GT(follower.in_force().linear_mps, 0.0);
}

TEST_F(Following, AnOldStateDoesNotPullThemBack) {
  want({1.0, 0.0, 0.0}, 200);
  follower.observe(vehicle, state_of(0.0), at_s(settings.stale_state_s + 0.1));
  EXPECT_NEAR(follower.in_force().linear_mps, 1.0, 1e-9);
}

TEST_F(Following, AfterAPauseTheMeasuredTwistIsInForce) {
  want({1.0, 0.0, 0.0}, 200);
  follower.restart(state_of(0.3));
  EXPECT_DOUBLE_EQ(follower.in_force().linear_mps, 0.3);
  follower.restart({});
  EXPECT_TRUE(is_zero(follower.in_force()));
}

TEST_F(Following, BrakesAlongTheArcThatIsDriven) {
  want({1.0, 0.4, 0.0}, 300);
  const geometry::Twist2 before = follower.in_force();
  const geometry::Twist2 braking = follower.braking(vehicle.limits);
  EXPECT_EQ(braking.linear_mps, 0.0);
  const double slower = before.linear_mps - vehicle.limits.max_deceleration_mps2 * settings.control_period_s;
  EXPECT_NEAR(braking.angular_radps / slower, before.angular_radps / before.linear_mps, 1e-9);
}

TEST_F(Following, AStandingTricyclesWheelIsWhereItIsMeasured) {
  vehicle = forklift();
  time::Latest<Motion> state;
  state.set({{3.0, 5.0, 0.0}, {}, 0.4}, kStart);
  follower.observe(vehicle, state, kStart);
  EXPECT_DOUBLE_EQ(follower.steering_rad(), 0.4);
  EXPECT_DOUBLE_EQ(follower.in_force().angular_radps, 0.0);
}

}  // namespace
}  // namespace aisle::local_planner
