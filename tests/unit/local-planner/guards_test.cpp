// Whatever is missing or old stops the vehicle, with its own reason; what is complete and fresh drives it.
#include <gtest/gtest.h>

#include <cmath>

#include "services/local-planner/core/local_planner.hpp"

namespace aisle::local_planner {
namespace {

using std::chrono::milliseconds;

class Guards : public ::testing::Test {
 protected:
  Guards() : clearance_(grid::OccupancyGrid(grid::Geometry{200, 200, 0.1, {}})) {
    inputs_.clearance = &clearance_;
    inputs_.map_revision = 7;
    inputs_.vehicle = Vehicle{"agv-1", 0.35, {}};
    Plan plan;
    plan.id = 1;
    plan.goal_id = "agv-1/0";
    plan.map_revision = 7;
    plan.goal_in_map = {16.0, 10.0, 0.0};
    plan.waypoints_in_map = {{4.0, 10.0}, {16.0, 10.0}};
    inputs_.plan = plan;
    hear_all();
  }

  void hear_all() {
    hear_state();
    inputs_.tracker_alive = now_;
  }
  void hear_state() { inputs_.state.set({{4.0, 10.0, 0.0}, twist_}, now_); }

  /// One cycle of 20 ms; the vehicle takes up the speed it was told, in its place.
  Output step() {
    now_ += milliseconds(20);
    const Output output = planner_.step(inputs_, now_);
    twist_ = output.twist;
    return output;
  }
  Output step_heard() {
    hear_all();
    return step();
  }
  void drive() {
    for (int i = 0; i < 25; ++i) step_heard();
  }
  void expect_stop(Reason reason) {
    Output output;
    for (int i = 0; i < 100; ++i) output = step();
    EXPECT_EQ(output.reason, reason) << "says " << name(output.reason);
    EXPECT_EQ(output.twist.linear_mps, 0.0);
    EXPECT_EQ(output.twist.angular_radps, 0.0);
  }
  void expect_stop_heard(Phase phase, Reason reason) {
    Output output;
    for (int i = 0; i < 100; ++i) output = step_heard();
    EXPECT_EQ(output.phase, phase) << "says " << name(output.phase);
    EXPECT_EQ(output.reason, reason) << "says " << name(output.reason);
    EXPECT_EQ(output.twist.linear_mps, 0.0);
  }

  time::Stamp now_{std::chrono::seconds(100)};
  geometry::Twist2 twist_;
  grid::ClearanceField clearance_;
  Inputs inputs_;
  LocalPlanner planner_;
};

TEST_F(Guards, DrivesTowardsTheGoalWhenEverythingIsFresh) {
  drive();
  const Output output = step_heard();
  EXPECT_EQ(output.phase, Phase::kDriving) << name(output.phase) << " " << name(output.reason);
  EXPECT_GT(output.twist.linear_mps, 0.2);
  EXPECT_NEAR(output.distance_left_m, 12.0, 0.5);
}

TEST_F(Guards, NeverChangesSpeedFasterThanTheVehicleCan) {
  const kinematics::Limits limits;
  double before = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double speed = step_heard().twist.linear_mps;
    EXPECT_LE(speed - before, limits.max_acceleration_mps2 * 0.02 + 1e-9) << "in cycle " << i;
    EXPECT_LE(speed, limits.max_speed_mps + 1e-9);
    before = speed;
  }
}

TEST_F(Guards, StopsForAStateOlderThan200Ms) {
  drive();
  for (int i = 0; i < 100; ++i) {
    inputs_.tracker_alive = now_;
    step();
  }
  const Output output = step();
  EXPECT_EQ(output.reason, Reason::kStaleState) << name(output.reason);
  EXPECT_EQ(output.twist.linear_mps, 0.0);
}

TEST_F(Guards, StopsForATrackerSilentFor500Ms) {
  drive();
  Output output;
  for (int i = 0; i < 150; ++i) {
    hear_state();
    output = step();
  }
  EXPECT_EQ(output.reason, Reason::kStaleTracker) << name(output.reason);
  EXPECT_EQ(output.twist.linear_mps, 0.0);
}

TEST_F(Guards, WaitsForAMap) {
  inputs_.clearance = nullptr;
  expect_stop_heard(Phase::kWaiting, Reason::kNoMap);
}

TEST_F(Guards, WaitsForATrackerThatNeverSpoke) {
  inputs_.tracker_alive = {};
  Output output;
  for (int i = 0; i < 10; ++i) {
    hear_state();
    output = step();
  }
  EXPECT_EQ(output.reason, Reason::kNoTracker) << name(output.reason);
  EXPECT_EQ(output.twist.linear_mps, 0.0);
}

TEST_F(Guards, HoldsWhenThePlanIsOfAnOlderMap) {
  drive();
  inputs_.map_revision = 8;
  expect_stop_heard(Phase::kHeld, Reason::kPlanOutdated);
}

TEST_F(Guards, FailsWhenThereIsNoPath) {
  inputs_.plan->outcome = Plan::Outcome::kNotFound;
  expect_stop_heard(Phase::kFailed, Reason::kUnreachable);
}

TEST_F(Guards, HoldsWhenTheGoalIsCancelled) {
  drive();
  inputs_.plan->outcome = Plan::Outcome::kCancelled;
  expect_stop_heard(Phase::kHeld, Reason::kCancelled);
}

TEST_F(Guards, HoldsWhenTheVehicleObeysAnother) {
  drive();
  inputs_.authority_lost = true;
  expect_stop_heard(Phase::kHeld, Reason::kAuthority);
}

TEST(Order, CountsWhereNamesEndInNumbers) {
  EXPECT_TRUE(outranks("agv-2", "agv-10"));
  EXPECT_FALSE(outranks("agv-10", "agv-2"));
}

}  // namespace
}  // namespace aisle::local_planner
