// How far a vehicle has come along its steps, and how far it may drive.
#include "services/local-planner/core/road.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

/// Steps of 2 m: along x from 3 to 9, then up y from 2 to 8. Numbers begin at 10.
class OnRoad : public testing::Test {
 protected:
  OnRoad() : stage({3.0, 2.0, 0.0}) {
    Plan& plan = give_plan({{3.0, 2.0}, {9.0, 2.0}, {9.0, 8.0}});
    plan.first_step = 10;
    plan.step_ends_m = {2.0, 4.0, 6.0, 8.0, 10.0, 12.0};
    plan.tube_m = 0.1;
  }

  Plan& give_plan(std::vector<Point2> waypoints) {
    stage.give_plan(std::move(waypoints));
    return *stage.inputs.plan;
  }

  void grant(std::uint64_t limit_step, bool gives_back = false) {
    Grant grant;
    grant.number = ++grants;
    grant.plan_id = stage.inputs.plan->id;
    grant.limit_step = limit_step;
    grant.gives_back = gives_back;
    stage.inputs.grant = grant;
    follow();
  }

  void follow(double speed_mps = 0.0) { road.follow(stage.moment(), speed_mps); }

  /// Drives straight to a point.
  void drive_to(Point2 to, double speed_mps = 0.0) {
    const Point2 from = stage.motion.base_now.position();
    for (int i = 1; i <= 20; ++i) {
      const Point2 p = from + (i / 20.0) * (to - from);
      stage.place({p.x, p.y, geometry::bearing(from, to)});
      follow(speed_mps);
    }
  }

  RoadReport report() const { return road.report(stage.moment()); }

  /// How far the lane stays away from the turn at (9, 2).
  double off_turn_m() const {
    const Lane lane = road.lane();
    return geometry::distance(lane.route.at(lane.route.project({9.0, 2.0}, 0.0, 100.0)), {9.0, 2.0});
  }

  Stage stage;
  Road road{LaneSettings{}, 0.6};
  std::uint64_t grants{0};
};

TEST_F(OnRoad, NothingIsGrantedAtFirst) {
  follow();
  EXPECT_DOUBLE_EQ(road.stop_at_m(), 0.0);
  EXPECT_EQ(report().limit_step, 10U);
  EXPECT_EQ(report().step_done, 10U);
  EXPECT_EQ(report().grant_number, 0U);
}

TEST_F(OnRoad, APlanWithoutStepsHasNoLimit) {
  stage.inputs.plan->step_ends_m.clear();
  follow();
  EXPECT_TRUE(std::isinf(road.stop_at_m()));
  EXPECT_TRUE(std::isinf(road.gate_m()));
  EXPECT_EQ(road.tube_m(), 0.0);
}

TEST_F(OnRoad, TheLimitIsTheEndOfTheLastStepThatIsGranted) {
  grant(12);
  EXPECT_DOUBLE_EQ(road.stop_at_m(), 4.0);
  EXPECT_DOUBLE_EQ(report().limit_m, 4.0);
  grant(13);
  EXPECT_DOUBLE_EQ(road.stop_at_m(), 6.0);
  EXPECT_EQ(report().grant_number, 2U);
}

TEST_F(OnRoad, AtTheGoalItStopsByItself) {
  grant(16);
  EXPECT_TRUE(std::isinf(road.stop_at_m()));
  stage.inputs.plan->goal_in_map = {3.0, 8.0, 0.0};  // elsewhere: the plan ends at a place to wait
  stage.inputs.plan->id = 2;
  grant(16);
  EXPECT_DOUBLE_EQ(road.stop_at_m(), 12.0);
}

TEST_F(OnRoad, AStepIsDoneWhenItsEndIsPassedOrTheVehicleStandsNearIt) {
  grant(14);
  drive_to({4.9, 2.0});
  EXPECT_EQ(report().step_done, 10U);
  drive_to({4.96, 2.0});
  EXPECT_EQ(report().step_done, 11U);
  drive_to({5.5, 2.0});
  EXPECT_NEAR(report().progress_m, 2.5, 1e-9);
  EXPECT_EQ(report().step_done, 11U);
}

TEST_F(OnRoad, IsNeverBeyondItsLimitNorBack) {
  grant(12);
  drive_to({8.0, 2.0});
  EXPECT_DOUBLE_EQ(report().progress_m, 4.0);
  EXPECT_EQ(report().step_done, 12U);
  drive_to({6.0, 2.0});
  EXPECT_DOUBLE_EQ(report().progress_m, 4.0);
}

TEST_F(OnRoad, ATurnIsRoundedOnlyWhereTheRoadIsGrantedBeyondIt) {
  grant(13);
  EXPECT_NEAR(off_turn_m(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(road.gate_m(), 6.0);
  const std::uint64_t before = road.lane_revision();
  grant(14);
  EXPECT_GT(road.lane_revision(), before);
  EXPECT_NEAR(off_turn_m(), arc_off_turn_m(0.5, 0.5 * geometry::kPi), 0.02);
  EXPECT_TRUE(std::isinf(road.gate_m()));
}

TEST_F(OnRoad, GrantedLateTheArcIsSmaller) {
  grant(13);
  drive_to({8.7, 2.0});
  grant(14);
  EXPECT_NEAR(off_turn_m(), arc_off_turn_m(0.25, 0.5 * geometry::kPi), 0.02);
}

TEST_F(OnRoad, GrantedAtTheTurnItTurnsThere) {
  grant(13);
  drive_to({8.91, 2.0});
  grant(14);
  EXPECT_NEAR(off_turn_m(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(road.gate_m(), 6.0);
  drive_to({8.98, 2.0});
  EXPECT_TRUE(std::isinf(road.gate_m())) << "it was there";
  drive_to({9.0, 2.5});
  EXPECT_NEAR(report().progress_m, 6.5, 1e-6);
}

TEST_F(OnRoad, AGateIsNotPassedBesideIt) {
  grant(13);
  drive_to({8.91, 2.0});
  grant(14);
  drive_to({8.9, 2.3});
  EXPECT_LE(report().progress_m, 6.0);
}

TEST_F(OnRoad, AnArcThatWasBegunStays) {
  grant(14);
  drive_to({8.6, 2.0});
  grant(13, true);
  EXPECT_NEAR(off_turn_m(), arc_off_turn_m(0.5, 0.5 * geometry::kPi), 0.02);
  EXPECT_EQ(report().limit_step, 14U) << "its floor is the next step's";
}

/// Warehouse, seed 10: before a person who stood for good, the vehicle kept the way that it could not drive.
TEST_F(OnRoad, OnceItStandsOnAnArcItGivesAllBackThatIsAskedFor) {
  grant(14);
  drive_to({8.6, 2.0}, 0.5);
  stage.inputs.grant->number = ++grants;
  stage.inputs.grant->limit_step = 12;
  stage.inputs.grant->gives_back = true;
  follow(0.5);
  EXPECT_EQ(report().limit_step, 14U) << "it drives";

  follow(0.0);
  EXPECT_EQ(report().limit_step, 12U);
  EXPECT_LE(road.stop_at_m(), report().progress_m);
}

TEST_F(OnRoad, AnArcKeepsAwayFromWalls) {
  grid::OccupancyGrid grid = hall(20.0, 10.0);
  block(grid, 3.0, 2.4, 8.6, 10.0);
  Stage narrow({3.0, 2.0, 0.0}, grid);
  narrow.inputs.plan = stage.inputs.plan;
  Grant all;
  all.number = 1;
  all.limit_step = 16;
  narrow.inputs.grant = all;
  road.follow(narrow.moment(), 0.0);
  EXPECT_LT(off_turn_m(), 0.12);
  const Route lane = road.lane().route;
  for (const Point2 p : lane.points()) EXPECT_GT(narrow.inputs.clearance->clearance_m(p), 0.35) << p.x;
}

TEST_F(OnRoad, GivesBackAsMuchAsItCanStopFor) {
  grant(14);
  drive_to({5.5, 2.0}, 1.0);  // 0.83 m to brake, 0.3 m to react
  stage.inputs.grant->number = ++grants;
  stage.inputs.grant->limit_step = 11;
  stage.inputs.grant->gives_back = true;
  follow(1.0);
  EXPECT_EQ(report().limit_step, 12U) << "the end of the step that it is on";
  EXPECT_EQ(report().grant_number, grants);
  EXPECT_NEAR(road.stop_at_m(), 2.5, 1e-9) << "it brakes";

  drive_to({6.4, 2.0}, 0.1);
  EXPECT_EQ(report().limit_step, 12U);
  follow(0.0);
  EXPECT_EQ(report().limit_step, 11U) << "it stays here";
  EXPECT_LE(road.stop_at_m(), report().progress_m);
}

TEST_F(OnRoad, GivesBackNoMoreThanIsAskedFor) {
  grant(15);
  grant(13, true);
  EXPECT_EQ(report().limit_step, 13U);
}

TEST_F(OnRoad, GoesOnWhereItIsOnAPlanThatRepeatsWhatIsGranted) {
  grant(13);
  drive_to({7.5, 2.0});
  Plan& next = give_plan({{7.0, 2.0}, {9.0, 2.0}, {15.0, 2.0}});
  next.id = 2;
  next.first_step = 12;
  next.step_ends_m = {2.0, 5.0, 8.0};
  next.tube_m = 0.1;
  grant(14);
  EXPECT_NEAR(report().progress_m, 0.5, 1e-9);
  EXPECT_EQ(report().step_done, 12U);
  EXPECT_DOUBLE_EQ(road.stop_at_m(), 5.0);
}

TEST_F(OnRoad, FindsItsPlaceAfterARestart) {
  stage.place({9.0, 5.0, 1.57});
  grant(15);
  follow();
  EXPECT_NEAR(report().progress_m, 9.0, 1e-6);
  EXPECT_EQ(report().step_done, 14U);
}

TEST_F(OnRoad, BeginsAPlanThatComesByHereAgainAtItsBeginning) {
  Plan& plan = give_plan({{3.0, 2.0}, {4.0, 2.0}, {3.0, 2.0}, {3.0, 6.0}});
  plan.step_ends_m = {1.0, 2.0, 6.0};
  plan.tube_m = 0.1;
  stage.place({2.99, 2.01, 0.0});
  grant(10 + 3);
  EXPECT_NEAR(report().progress_m, 0.0, 0.05);
}

TEST_F(OnRoad, NumbersThatBeginAnewAreAnotherRegistration) {
  grant(14);
  drive_to({5.5, 2.0});
  Plan& next = give_plan({{5.5, 2.0}, {9.0, 2.0}});
  next.id = 1;
  next.first_step = 0;
  next.step_ends_m = {3.5};
  grant(1);
  EXPECT_EQ(report().step_done, 0U);
  EXPECT_EQ(report().limit_step, 1U);
}

TEST_F(OnRoad, APlanThatWasCancelledLeavesItOnTheRoadOfTheOneBefore) {
  grant(14);
  drive_to({5.5, 2.0});
  stage.inputs.plan->outcome = fleet::PlanOutcome::kCancelled;
  stage.inputs.plan->step_ends_m.clear();
  drive_to({5.7, 2.0});
  EXPECT_EQ(report().limit_step, 14U);
  EXPECT_NEAR(report().progress_m, 2.7, 1e-9);
}

TEST_F(OnRoad, TellsThePosesUpToItsLimit) {
  grant(14);
  drive_to({5.5, 2.0});
  const std::vector<HeldPose> held = report().held;
  ASSERT_EQ(held.size(), 4U);
  EXPECT_NEAR(held[0].base_in_map.x, 5.5, 1e-9);
  EXPECT_EQ(held[0].step, 11U);
  EXPECT_NEAR(held[1].base_in_map.x, 7.0, 1e-9);
  EXPECT_EQ(held[1].step, 11U);
  EXPECT_EQ(held[2].step, 12U);
  EXPECT_NEAR(held[2].base_in_map.yaw, 0.0, 1e-9);
  EXPECT_EQ(held[3].step, 13U);
  EXPECT_NEAR(held[3].base_in_map.y, 4.0, 1e-9);
  EXPECT_NEAR(held[3].base_in_map.yaw, 0.5 * geometry::kPi, 1e-9);
}

TEST_F(OnRoad, TakesNoMoreThanItCanTell) {
  Plan& plan = *stage.inputs.plan;
  plan.step_ends_m.clear();
  for (int i = 1; i <= 60; ++i) plan.step_ends_m.push_back(0.2 * i);
  grant(10 + 60);
  EXPECT_LE(report().held.size(), 32U);
  EXPECT_EQ(report().held.back().step + 1, report().limit_step);

  const std::uint64_t before = report().limit_step;
  drive_to({4.0, 2.0});
  EXPECT_EQ(report().limit_step, before + 5) << "more as it goes on";
}

TEST_F(OnRoad, DrivesOutAndBackInOrder) {
  Plan& plan = give_plan({{3.0, 2.0}, {5.0, 2.0}, {3.0, 2.0}, {3.0, 6.0}});
  plan.first_step = 10;
  plan.step_ends_m = {2.0, 4.0, 8.0};
  plan.tube_m = 0.1;
  grant(13);
  drive_to({4.8, 2.0});
  EXPECT_NEAR(report().progress_m, 1.8, 1e-6) << "not on the way back yet";
  drive_to({5.0, 2.0});
  drive_to({3.5, 2.0});
  EXPECT_NEAR(report().progress_m, 3.5, 1e-6);
  EXPECT_EQ(report().step_done, 11U);
}

}  // namespace
}  // namespace aisle::local_planner
