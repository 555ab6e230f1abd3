// May the vehicle drive? Each thing that is missing, old or late, by itself.
#include "services/local-planner/core/guard.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class GuardOf : public testing::Test {
 protected:
  GuardOf() { guard.begin(stage.inputs.map_revision, kStart); }

  void expect(Phase phase, Reason reason, double later_s = 0.0) {
    const auto stopped = guard.judge(stage.inputs, false, at_s(later_s));
    ASSERT_TRUE(stopped) << name(reason);
    EXPECT_EQ(stopped->phase, phase) << name(stopped->phase);
    EXPECT_EQ(stopped->reason, reason) << name(stopped->reason);
  }

  Stage stage;
  Settings settings;
  Guard guard{settings};
};

TEST_F(GuardOf, EverythingThatIsThereAndFreshLetsItDrive) {
  EXPECT_FALSE(guard.judge(stage.inputs, false, kStart));
  EXPECT_FALSE(guard.judge(stage.inputs, false, at_s(settings.stale_state_s)));
}

TEST_F(GuardOf, WhatNeverCameIsWaitedFor) {
  stage.inputs.tracker_alive = {};
  expect(Phase::kWaiting, Reason::kNoTracker);
  stage.inputs.plan.reset();
  expect(Phase::kWaiting, Reason::kNoGoal);
  stage.inputs.clearance = nullptr;
  expect(Phase::kWaiting, Reason::kNoMap);
  stage.inputs.state.clear();
  expect(Phase::kWaiting, Reason::kNoState);
}

TEST_F(GuardOf, AStateThatIsOldHoldsIt) { expect(Phase::kHeld, Reason::kStaleState, settings.stale_state_s + 0.01); }

TEST_F(GuardOf, AHigherEpochHoldsItWhateverElseIsMissing) {
  stage.inputs.authority_lost = true;
  stage.inputs.plan.reset();
  expect(Phase::kHeld, Reason::kAuthority);
}

TEST_F(GuardOf, ASilentTrackerIsToldFromOneThatIsBlindOnThisVehicle) {
  const double later_s = settings.stale_tracker_s + 0.1;
  stage.inputs.state.set({}, at_s(later_s));
  expect(Phase::kHeld, Reason::kStaleTracker, later_s);
  EXPECT_EQ(guard.judge(stage.inputs, false, at_s(later_s))->detail, "");
  stage.inputs.tracker_heard = at_s(later_s);
  EXPECT_EQ(guard.judge(stage.inputs, false, at_s(later_s))->detail,
            "the tracker works, but has no fresh scan of agv-1");
}

TEST_F(GuardOf, APlanWithoutAPathHasFailedAndSaysWhy) {
  stage.inputs.plan->outcome = fleet::PlanOutcome::kNoPath;
  stage.inputs.plan->detail = "the goal is in a wall";
  expect(Phase::kFailed, Reason::kUnreachable);
  EXPECT_EQ(guard.judge(stage.inputs, false, kStart)->detail, "the goal is in a wall");
  stage.inputs.plan->outcome = fleet::PlanOutcome::kCancelled;
  expect(Phase::kHeld, Reason::kCancelled);
}

TEST_F(GuardOf, APlanOfAnOlderMapIsDrivenForAWhileOnly) {
  stage.inputs.map_revision = 2;
  guard.begin(2, at_s(0.1));
  EXPECT_FALSE(guard.judge(stage.inputs, false, at_s(0.15)));
  const double later_s = 0.1 + settings.plan_update_s + 0.01;
  stage.inputs.state.set({}, at_s(later_s));
  stage.inputs.tracker_alive = at_s(later_s);
  expect(Phase::kHeld, Reason::kPlanOutdated, later_s);
  EXPECT_FALSE(guard.judge(stage.inputs, true, at_s(later_s))) << "at the goal it needs no newer plan";
}

TEST_F(GuardOf, ALateCycleHoldsItForAWhile) {
  EXPECT_FALSE(guard.begin(1, at_s(0.02)));
  const auto late_s = guard.begin(1, at_s(0.32));
  ASSERT_TRUE(late_s);
  EXPECT_NEAR(*late_s, 0.3, 1e-9);
  stage.inputs.state.set({}, at_s(0.32));
  expect(Phase::kHeld, Reason::kLate, 0.4);
  stage.inputs.state.set({}, at_s(0.32 + settings.late_hold_s));
  stage.inputs.tracker_alive = at_s(0.32 + settings.late_hold_s);
  EXPECT_FALSE(guard.judge(stage.inputs, false, at_s(0.32 + settings.late_hold_s)));
}

TEST(Guard, TheFirstCycleIsNotLate) {
  Guard guard{Settings{}};
  EXPECT_FALSE(guard.begin(1, kStart));
}

}  // namespace
}  // namespace aisle::local_planner
