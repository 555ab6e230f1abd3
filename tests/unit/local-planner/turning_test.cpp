// When a vehicle turns on the spot, and how fast.
#include "services/local-planner/core/turning.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class Turning : public testing::Test {
 protected:
  /// One cycle with the target so far to the left of the heading.
  bool look(double error_rad, double distance_m = 1.0, double left_m = 10.0, bool stays_here = false) {
    const Moment moment = stage.moment();
    const Scene scene{
        *stage.inputs.clearance, stage.motion.base_then,    {},  moment.discs.radius_m, moment.vehicle.limits, 1.0,
        stage.around.movers,     stage.around.peer_motions, 0.0, moment.discs.ahead_m};
    const Target target{{}, error_rad, distance_m};
    return turn.look({scene, moment.vehicle, target, left_m, stays_here}, DwaSettings{});
  }

  Stage stage;
  TurnOnTheSpot turn;
};

TEST_F(Turning, BeginsAtALargeErrorAndEndsAtASmallOne) {
  EXPECT_FALSE(look(0.8));
  EXPECT_TRUE(look(0.95));
  EXPECT_TRUE(look(0.5)) << "once begun, it is ended";
  EXPECT_FALSE(look(0.15));
  EXPECT_FALSE(look(0.5));
  EXPECT_TRUE(look(-0.95));
}

TEST_F(Turning, BeginsEarlierNearTheWaysEnd) { EXPECT_TRUE(look(0.5, 1.0, 0.5)); }

TEST_F(Turning, TheDirectionToATargetUnderTheVehicleSaysNothing) {
  EXPECT_FALSE(look(2.0, 0.02));
  EXPECT_TRUE(look(2.0, 0.1));
  EXPECT_FALSE(look(2.0, 0.02)) << "ends it";
}

TEST_F(Turning, StaysBeforeWhatObstructsItsWay) { EXPECT_FALSE(look(2.0, 1.0, 10.0, true)); }

TEST_F(Turning, IsForgottenWhenTheVehicleIsHeld) {
  EXPECT_TRUE(look(1.0));
  turn.end();
  EXPECT_FALSE(look(0.5));
}

TEST_F(Turning, AForkliftNeverTurnsOnTheSpot) {
  stage.inputs.vehicle = forklift();
  EXPECT_FALSE(look(2.0));
}

TEST_F(Turning, ARectangleLooksWhereItsCornersGo) {
  Vehicle vehicle{"agv-1", geometry::rectangle(2.0, 0.6), {}, 10.0, 0.2};
  stage.inputs.vehicle = vehicle;
  EXPECT_TRUE(look(1.5));
  turn.end();

  Stage narrow({10.0, 5.0, 0.0}, aisle(0.9));
  narrow.inputs.vehicle = vehicle;
  stage.inputs.clearance = narrow.inputs.clearance;
  stage.place({10.0, 5.0, 0.1});
  EXPECT_FALSE(look(1.5)) << "its corner is near the wall of an aisle";
}

TEST(TurnBy, IsAsFastAsItCanStillStopAndNoFasterThanTheLimit) {
  const kinematics::Limits limits;
  const double error_rad = 0.1;
  EXPECT_NEAR(turn_by(error_rad, limits).angular_radps, std::sqrt(limits.max_turn_acceleration_radps2 * error_rad),
              1e-9);
  EXPECT_DOUBLE_EQ(turn_by(3.0, limits).angular_radps, limits.max_turn_radps);
  EXPECT_DOUBLE_EQ(turn_by(-3.0, limits).angular_radps, -limits.max_turn_radps);
}

TEST(TurnTwist, ComesToAStandFirst) {
  const kinematics::Limits limits;
  const geometry::Twist2 twist = TurnOnTheSpot::twist(1.0, {0.5, 0.4, 0.0}, limits);
  EXPECT_EQ(twist.linear_mps, 0.0);
  EXPECT_DOUBLE_EQ(twist.angular_radps, 0.2);
  EXPECT_GT(TurnOnTheSpot::twist(1.0, {}, limits).angular_radps, 0.5);
}

}  // namespace
}  // namespace aisle::local_planner
