#include "tools/referee/core/judge.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace aisle::referee {
namespace {

BodySample vehicle(double t_s, double x_m, double speed_mps) {
  return {"agv-1", BodyKind::kVehicle, {0.35, 0.0, 0.0}, {x_m, 0.0, 0.0}, speed_mps, t_s, 1};
}
GoalRecord goal_at(double x_m) {
  GoalRecord goal;
  goal.agv_id = "agv-1";
  goal.goal_id = "g1";
  goal.pose_in_map = {x_m, 0.0, 0.0};
  goal.position_tolerance_m = 0.1;
  return goal;
}
PlanNews plan(double written_s, std::uint64_t id, std::uint64_t revision, double arrives_late_s = 0.0) {
  PlanNews news;
  news.agv_id = "agv-1";
  news.plan_id = id;
  news.goal_id = "g1";
  news.map_revision = revision;
  news.found = true;
  news.planning_ms = 2.0;
  news.stamp_ns = static_cast<std::int64_t>(written_s * 1e9);
  news.t_s = written_s + arrives_late_s;
  return news;
}

/// Drives 2 m, stands 1 s on the way, drives 2 m, arrives.
void drive(Judge& judge) {
  judge.goal_arrived(goal_at(4.0), false);
  double x_m = 0.0;
  for (int i = 0; i <= 300; ++i) {
    const double t_s = 0.02 * i;
    const bool drives = t_s < 2.0 || (t_s >= 3.0 && t_s < 5.0);
    if (drives) x_m += 0.02;
    judge.body_seen(vehicle(t_s, x_m, drives ? 1.0 : 0.0));
    if (t_s >= 5.0) judge.navigation_arrived({"agv-1", "g1", GoalNews::Phase::kArrived, "", t_s}, false);
  }
}

TEST(Judge, AGoalIsReachedWhereTheVehiclesFrameIsAndNotItsMiddle) {
  Judge judge(nullptr, {{{"agv-1", 1}}});
  judge.goal_arrived(goal_at(4.0), false);
  judge.body_seen({"agv-1", BodyKind::kVehicle, {0.0, 2.4, 1.1}, {4.0, 0.0, 0.0}, 0.0, 1.0, 1, 0.4});
  judge.navigation_arrived({"agv-1", "g1", GoalNews::Phase::kArrived, "", 1.0}, false);
  const RunReport report = judge.finish(2.0);
  ASSERT_EQ(report.goals.size(), 1u);
  EXPECT_EQ(report.goals[0].outcome, GoalOutcome::kReached);
  EXPECT_EQ(report.vehicles.at("agv-1").ahead_m, 0.4);
}

TEST(Judge, CountsDistanceAndStopsOnTheWay) {
  Judge judge(nullptr, {{{"agv-1", 1}}});
  drive(judge);
  const RunReport report = judge.finish(6.0);
  EXPECT_NEAR(report.distance_m(), 4.0, 0.05);
  EXPECT_EQ(report.stops(), 1);  // the stand at the goal is none
  EXPECT_EQ(report.count(GoalOutcome::kReached), 1);
  EXPECT_TRUE(report.passed());
}

TEST(Judge, IsOverWhenAllGoalsAreDecidedAndAllStand) {
  Judge judge(nullptr, {{{"agv-1", 1}}});
  EXPECT_FALSE(judge.is_over(0.0));
  drive(judge);
  EXPECT_FALSE(judge.is_over(5.5));  // stands since 5.02
  EXPECT_TRUE(judge.is_over(6.1));
}

TEST(Judge, IsOverWhenAVehicleHasReportedFailureForLong) {
  Judge judge(nullptr, {{{"agv-1", 2}}});
  judge.goal_arrived(goal_at(4.0), false);
  judge.body_seen(vehicle(0.0, 0.0, 0.0));
  judge.body_seen(vehicle(3.0, 0.0, 0.0));
  judge.navigation_arrived({"agv-1", "g1", GoalNews::Phase::kFailed, "failed: no path", 3.0}, false);
  EXPECT_FALSE(judge.is_over(3.0 + Judge::kGiveUp_s - 0.1));
  EXPECT_TRUE(judge.is_over(3.0 + Judge::kGiveUp_s + 0.1));
  judge.navigation_arrived({"agv-1", "g1", GoalNews::Phase::kOther, "driving", 34.0}, false);
  EXPECT_FALSE(judge.is_over(35.0));
}

TEST(Judge, CountsAGoalThatWasNeverGivenAsMissed) {
  Judge judge(nullptr, {{{"agv-1", 2}}});
  drive(judge);
  EXPECT_FALSE(judge.is_over(10.0));
  const RunReport report = judge.finish(6.0);
  EXPECT_EQ(report.goals_missed(), 1);
  EXPECT_FALSE(report.passed());
}

TEST(Judge, TimesTheFirstPlanThatKnowsAnEdit) {
  Judge judge(nullptr, {{{"agv-1", 1}}});
  judge.goal_arrived(goal_at(4.0), false);
  judge.plan_arrived(plan(1.0, 7, 3));
  EditRow edit;
  edit.edit_id = "e1";
  edit.asked_stamp_ns = 1'990'000'000;
  judge.edit_asked(edit);
  judge.edit_answered({"e1", true, "applied", 4, 2.0});
  judge.plan_arrived(plan(2.01, 7, 3));       // knows nothing of it yet
  judge.plan_arrived(plan(2.03, 7, 4, 0.3));  // checked again and kept; a busy referee reads it late
  judge.plan_arrived(plan(3.0, 8, 4));
  const RunReport report = judge.finish(4.0);
  ASSERT_EQ(report.map_edit_to_plan_ms.count(), 1u);
  EXPECT_NEAR(*report.map_edit_to_plan_ms.max(), 40.0, 1e-6);
  EXPECT_EQ(report.replans(), 1);
  EXPECT_EQ(report.planning_ms.count(), 2u);
}

TEST(Judge, TimesAPlanThatItReadBeforeTheAnswerToTheEdit) {
  Judge judge(nullptr, {{{"agv-1", 1}}});
  judge.goal_arrived(goal_at(4.0), false);
  EditRow edit;
  edit.edit_id = "e1";
  edit.asked_stamp_ns = 2'000'000'000;
  judge.edit_asked(edit);
  judge.plan_arrived(plan(2.06, 8, 4));
  judge.edit_answered({"e1", true, "applied", 4, 2.07});
  const RunReport report = judge.finish(4.0);
  ASSERT_EQ(report.map_edit_to_plan_ms.count(), 1u);
  EXPECT_NEAR(*report.map_edit_to_plan_ms.max(), 60.0, 1e-6);
}

TEST(Judge, MeasuresGapsOfCommandsAndHowOldTheirScansAre) {
  Judge judge(nullptr, {});
  judge.command_arrived({"agv-1", 1'030'000'000, 1'000'000'000, 3.0, 1.03});
  judge.command_arrived({"agv-1", 1'050'000'000, 1'000'000'000, 3.0, 1.05});  // the same scan: no new figure
  judge.command_arrived({"agv-1", 1'120'000'000, 1'100'000'000, 5.0, 1.12});
  const RunReport report = judge.finish(2.0);
  EXPECT_EQ(report.scan_to_command_ms().count(), 2u);
  EXPECT_NEAR(*report.scan_to_command_ms().max(), 30.0, 1e-9);
  EXPECT_NEAR(*report.command_gap_ms().max(), 70.0, 1e-6);
  EXPECT_NEAR(*report.control_ms.quantile(0.5), 3.0, 1e-9);
}

TEST(Judge, CountsRestartsAndMeansOfServices) {
  Judge judge(nullptr, {});
  judge.health_arrived({"map-1", "map", 1, 99.0, 10.0});  // includes the time before there was a sample
  judge.health_arrived({"map-1", "map", 1, 4.0, 12.0});
  judge.health_arrived({"map-1", "map", 2, 99.0, 11.0});
  judge.health_arrived({"map-1", "map", 2, 6.0, 11.0});
  const RunReport report = judge.finish(2.0);
  EXPECT_EQ(report.services.at("map-1").starts, 2);
  EXPECT_NEAR(report.cpu_percent_total(), 5.0, 1e-9);
  EXPECT_NEAR(report.services.at("map-1").resident_mb_max, 12.0, 1e-9);
}

TEST(Judge, HoldsATouchAgainstTheFleetUnlessARecordedPersonWalkedIntoAStandingVehicle) {
  Judge judge(nullptr, {});
  for (int i = 0; i <= 100; ++i) {
    const double t_s = 0.02 * i;
    judge.body_seen(vehicle(t_s, 0.0, 0.0));
    judge.body_seen({"p", BodyKind::kPerson, {0.25, 0, 0}, {2.0 - t_s, 0, 0}, 1.0, t_s, 1});
  }
  RunReport report = judge.finish(2.0);
  ASSERT_EQ(report.contacts.size(), 1u);
  EXPECT_EQ(report.contacts_moving_vehicle(), 0);
  EXPECT_FALSE(report.passed());
  report.people_give_way = false;
  EXPECT_TRUE(report.passed());
}

TEST(Judge, FailsARunInWhichAPersonIsPassedNearerThanTheScenarioAllows) {
  Judge judge(nullptr, {});
  for (int i = 0; i <= 100; ++i) {
    const double t_s = 0.02 * i;
    judge.body_seen(vehicle(t_s, 0.0, 0.0));
    judge.body_seen({"p", BodyKind::kPerson, {0.25, 0, 0}, {1.0 - t_s, 0.8, 0}, 1.0, t_s, 1});
  }
  RunReport report = judge.finish(2.0);
  ASSERT_TRUE(report.contacts.empty());
  const double least_m = report.clearances.least_m[static_cast<std::size_t>(PairClass::kVehiclePerson)].value();
  EXPECT_TRUE(report.passed()) << "nothing is asked for";
  report.person_clearance_m = least_m - 0.01;
  EXPECT_TRUE(report.passed());
  report.person_clearance_m = least_m + 0.01;
  EXPECT_FALSE(report.passed());
}

}  // namespace
}  // namespace aisle::referee
