#include "common/fleet/plan_authority.hpp"

#include <gtest/gtest.h>

namespace aisle::fleet {
namespace {

TEST(PlanAuthority, FollowsTheNewestEpochHeard) {
  PlanAuthority authority;
  EXPECT_EQ(authority.judge(2, 20, 1), PlanVerdict::kAccepted);
  EXPECT_EQ(authority.judge(1, 10, 99), PlanVerdict::kOldEpoch);
  EXPECT_EQ(authority.judge(3, 30, 1), PlanVerdict::kAccepted);
  EXPECT_EQ(authority.judge(2, 20, 2), PlanVerdict::kOldEpoch);
  EXPECT_EQ(authority.epoch(), 3U);
}

TEST(PlanAuthority, LearnsTheEpochFromPlansForOthersToo) {
  PlanAuthority authority;
  EXPECT_EQ(authority.judge(1, 10, 1), PlanVerdict::kAccepted);
  authority.hear(2);
  EXPECT_EQ(authority.judge(1, 10, 2), PlanVerdict::kOldEpoch);
  authority.hear(1);
  EXPECT_EQ(authority.epoch(), 2U);
}

TEST(PlanAuthority, TakesThePlansOfOnePlannerInTheirOrder) {
  PlanAuthority authority;
  EXPECT_EQ(authority.judge(1, 10, 5), PlanVerdict::kAccepted);
  EXPECT_EQ(authority.judge(1, 10, 4), PlanVerdict::kOldSequence);
  EXPECT_EQ(authority.judge(1, 10, 5), PlanVerdict::kAccepted) << "it is the one that is followed";
  EXPECT_EQ(authority.judge(1, 11, 1), PlanVerdict::kAccepted) << "another planner counts from the beginning";
}

}  // namespace
}  // namespace aisle::fleet
