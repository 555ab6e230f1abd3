// Is the vehicle at its goal?
#include "services/local-planner/core/arrival.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class ArrivalAt : public testing::Test {
 protected:
  ArrivalAt() { arrival.begin(kStart); }

  /// A cycle at this pose, standing. The goal is (15, 5), its tolerance 0.15 m.
  std::optional<AtGoal> look(const geometry::Pose2& base, double later_s = 0.0) {
    stage.place(base);
    return arrival.look(stage.moment(later_s), {});
  }

  Stage stage;
  Arrival arrival;
};

TEST_F(ArrivalAt, DrivesOnToTheGoalsMiddleWithinItsTolerance) {
  EXPECT_FALSE(look({14.0, 5.0, 0.0}));
  EXPECT_FALSE(look({14.9, 5.0, 0.0})) << "near, and gets nearer";
  ASSERT_TRUE(look({14.99, 5.0, 0.0}));
  EXPECT_TRUE(arrival.has_arrived());
}

TEST_F(ArrivalAt, AbreastOfTheGoalOrBeyondItGetsNoNearer) {
  EXPECT_TRUE(look({15.0, 5.1, 0.0}));
  arrival.begin(kStart);
  EXPECT_TRUE(look({15.1, 5.0, 0.0}));
}

TEST_F(ArrivalAt, NearForLongIsEnough) {
  EXPECT_FALSE(look({14.0, 5.0, 0.0}, 10.0));
  EXPECT_FALSE(look({14.9, 5.0, 0.0}, 10.1));
  EXPECT_FALSE(look({14.9, 5.0, 0.0}, 12.9));
  EXPECT_TRUE(look({14.9, 5.0, 0.0}, 13.1));
}

TEST_F(ArrivalAt, StopsBeforeItHasArrived) {
  stage.place({15.0, 5.0, 0.0});
  const auto at_goal = arrival.look(stage.moment(), {0.3, 0.0, 0.0});
  ASSERT_TRUE(at_goal);
  EXPECT_EQ(at_goal->phase, Phase::kDriving);
  EXPECT_TRUE(is_zero(at_goal->wanted));
  EXPECT_FALSE(arrival.has_arrived());
  EXPECT_EQ(look({15.0, 5.0, 0.0})->phase, Phase::kArrived);
}

TEST_F(ArrivalAt, TurnsToTheGoalsHeadingWhereItMatters) {
  stage.inputs.plan->goal_in_map.yaw = 1.0;
  EXPECT_EQ(look({15.0, 5.0, 0.0})->phase, Phase::kArrived);

  arrival.begin(kStart);
  stage.inputs.plan->yaw_tolerance_rad = 0.1;
  const auto turning = look({15.0, 5.0, 0.0});
  EXPECT_EQ(turning->phase, Phase::kTurning);
  EXPECT_GT(turning->wanted.angular_radps, 0.0);
  EXPECT_EQ(look({15.0, 5.0, 0.97})->phase, Phase::kArrived);
}

TEST_F(ArrivalAt, AVehicleThatCannotTurnOnTheSpotTakesItsHeadingAsItIs) {
  stage.inputs.vehicle = forklift();
  stage.inputs.plan->goal_in_map.yaw = 1.0;
  stage.inputs.plan->yaw_tolerance_rad = 0.1;
  EXPECT_EQ(look({15.0, 5.0, 0.0})->phase, Phase::kArrived);
}

TEST_F(ArrivalAt, PushedAwayItDrivesBack) {
  look({15.0, 5.0, 0.0});
  EXPECT_TRUE(look({15.0, 5.25, 0.0})) << "within twice the tolerance";
  EXPECT_FALSE(look({14.5, 5.0, 0.0}));
  EXPECT_FALSE(arrival.has_arrived());
}

TEST_F(ArrivalAt, AnotherGoalIsNotReachedYet) {
  look({15.0, 5.0, 0.0});
  arrival.begin(at_s(1.0));
  EXPECT_FALSE(arrival.has_arrived());
}

}  // namespace
}  // namespace aisle::local_planner
