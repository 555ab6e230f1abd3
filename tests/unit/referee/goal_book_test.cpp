#include "tools/referee/core/goal_book.hpp"

#include <gtest/gtest.h>

namespace aisle::referee {
namespace {

GoalRecord goal(const std::string& id, double t_s = 0.0) {
  GoalRecord record;
  record.agv_id = "agv-1";
  record.goal_id = id;
  record.pose_in_map = {5.0, 0.0, 0.0};
  record.position_tolerance_m = 0.1;
  record.assigned_s = t_s;
  return record;
}
GoalNews says(GoalNews::Phase phase, const std::string& id, const std::string& reason = "") {
  return {"agv-1", id, phase, reason, 9.0};
}

TEST(GoalBook, BelievesAnArrivalThatGroundTruthConfirms) {
  GoalBook book;
  book.assigned(goal("g1"), false);
  ASSERT_NE(book.open_goal("agv-1"), nullptr);
  book.heard(says(GoalNews::Phase::kArrived, "g1"), {4.95, 0.05, 0.0});
  EXPECT_EQ(book.count(GoalOutcome::kReached), 1);
  EXPECT_EQ(book.open_goal("agv-1"), nullptr);
}

TEST(GoalBook, DoesNotBelieveAnArrivalFromAfar) {
  GoalBook book;
  book.assigned(goal("g1"), false);
  book.heard(says(GoalNews::Phase::kArrived, "g1"), {3.0, 0.0, 0.0});
  book.close(20.0);
  EXPECT_EQ(book.count(GoalOutcome::kFailed), 1);
  EXPECT_NE(book.all()[0].reason.find("2.00 m away"), std::string::npos);
}

TEST(GoalBook, DoesNotTakeTheArrivalAtAnotherGoal) {
  GoalBook book;
  book.assigned(goal("g1"), false);
  book.heard(says(GoalNews::Phase::kArrived, "g0"), {5.0, 0.0, 0.0});
  EXPECT_EQ(book.count(GoalOutcome::kReached), 0);
}

TEST(GoalBook, CallsAGoalFailedThatIsReplacedAndSaysWhy) {
  GoalBook book;
  book.assigned(goal("g1"), false);
  book.heard(says(GoalNews::Phase::kFailed, "g1", "failed: no path"), {0.0, 0.0, 0.0});
  book.assigned(goal("g2"), false);
  EXPECT_EQ(book.count(GoalOutcome::kFailed), 1);
  EXPECT_EQ(book.all()[0].reason, "failed: no path; replaced by g2");
}

TEST(GoalBook, KeepsAGoalThatIsSentAgainByARestartedDispatcher) {
  GoalBook book;
  book.assigned(goal("g1"), false);
  book.heard(says(GoalNews::Phase::kArrived, "g1"), {5.0, 0.0, 0.0});
  book.assigned(goal("g1"), false);
  EXPECT_EQ(book.assigned_count(), 1);
  EXPECT_EQ(book.count(GoalOutcome::kReached), 1);
}

TEST(GoalBook, KnowsACancelledGoal) {
  GoalBook book;
  book.assigned(goal("g1"), false);
  book.assigned(goal("g1", 3.0), true);
  book.close(9.0);
  EXPECT_EQ(book.count(GoalOutcome::kCancelled), 1);
  EXPECT_EQ(book.count(GoalOutcome::kFailed), 0);
}

}  // namespace
}  // namespace aisle::referee
