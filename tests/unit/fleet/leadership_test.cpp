#include "common/fleet/leadership.hpp"

#include <gtest/gtest.h>

namespace aisle::fleet {
namespace {

using Role = Leadership::Role;
using std::chrono::milliseconds;

constexpr time::Stamp kStart = std::chrono::seconds(50);

TEST(Leadership, TakesTheLeadWhenItHearsNobody) {
  Leadership lead(false, 10);
  EXPECT_FALSE(lead.step(kStart, 0));
  EXPECT_FALSE(lead.step(kStart + milliseconds(499), 0));
  EXPECT_TRUE(lead.step(kStart + milliseconds(500), 0));
  EXPECT_EQ(lead.role(), Role::kLeading);
  EXPECT_EQ(lead.epoch(), 1U);
}

TEST(Leadership, StandsByWhenAnotherPlansAndFollowsItWithTheNextEpoch) {
  Leadership lead(false, 10);
  lead.step(kStart, 1);
  lead.hear(4, 3);
  EXPECT_TRUE(lead.step(kStart + milliseconds(100), 1));
  EXPECT_EQ(lead.role(), Role::kStandby);
  EXPECT_FALSE(lead.step(kStart + std::chrono::hours(1), 1));
  lead.lose_leader();
  EXPECT_TRUE(lead.step(kStart + std::chrono::hours(1), 1));
  EXPECT_EQ(lead.role(), Role::kLeading);
  EXPECT_EQ(lead.epoch(), 5U);
}

TEST(Leadership, WaitsLongerForALeaderThatItNeverHeard) {
  Leadership standby(true, 10);
  standby.step(kStart, 0);
  EXPECT_TRUE(standby.step(kStart + milliseconds(500), 0));
  EXPECT_EQ(standby.role(), Role::kStandby);
  standby.step(kStart + milliseconds(2900), 1);  // there it is, without plans yet
  standby.lose_leader();                         // nothing of it was heard
  EXPECT_FALSE(standby.step(kStart + milliseconds(5800), 0));
  EXPECT_TRUE(standby.step(kStart + milliseconds(5900), 0));
  EXPECT_EQ(standby.role(), Role::kLeading);
}

TEST(Leadership, GivesWayToAHigherEpochOnly) {
  Leadership lead(false, 10);
  lead.step(kStart, 0);
  lead.step(kStart + milliseconds(500), 0);
  lead.hear(1, 11);  // same epoch, started later: that one gives way
  EXPECT_FALSE(lead.step(kStart + milliseconds(600), 1));
  lead.hear(2, 11);
  EXPECT_TRUE(lead.step(kStart + milliseconds(700), 1));
  EXPECT_EQ(lead.role(), Role::kStandby);
  lead.lose_leader();
  lead.step(kStart + milliseconds(800), 1);
  EXPECT_EQ(lead.epoch(), 3U);
}

TEST(Leadership, SettlesTwoLeadersOfOneEpochByWhoStartedFirst) {
  Leadership first(false, 10), second(false, 11);
  for (Leadership* lead : {&first, &second}) {
    lead->step(kStart, 0);
    lead->step(kStart + milliseconds(500), 0);
  }
  first.hear(1, 11);
  second.hear(1, 10);
  first.step(kStart + milliseconds(600), 1);
  second.step(kStart + milliseconds(600), 1);
  EXPECT_EQ(first.role(), Role::kLeading);
  EXPECT_EQ(second.role(), Role::kStandby);
}

TEST(Leadership, BeginsAboveTheEpochOfPlannersThatAreAllGone) {
  Leadership lead(false, 10);
  lead.step(kStart, 0);
  lead.hear_of(7);  // a vehicle followed it
  EXPECT_FALSE(lead.step(kStart + milliseconds(400), 0)) << "that is nobody to stand by for";
  EXPECT_TRUE(lead.step(kStart + milliseconds(500), 0));
  EXPECT_EQ(lead.role(), Role::kLeading);
  EXPECT_EQ(lead.epoch(), 8U);
}

TEST(Leadership, RaisesItsEpochWhenALaterOneIsFollowedAndItsPlannerIsNotThere) {
  Leadership lead(false, 10);
  lead.step(kStart, 0);
  lead.step(kStart + milliseconds(500), 0);
  lead.hear_of(1);  // ours
  EXPECT_FALSE(lead.step(kStart + milliseconds(5000), 0));
  lead.hear_of(7);
  EXPECT_FALSE(lead.step(kStart + milliseconds(6000), 0));
  EXPECT_FALSE(lead.step(kStart + milliseconds(6999), 0));
  EXPECT_TRUE(lead.step(kStart + milliseconds(7000), 0));
  EXPECT_EQ(lead.role(), Role::kLeading);
  EXPECT_EQ(lead.epoch(), 8U);
}

TEST(Leadership, NeverRaisesItsEpochOverALeaderThatIsThere) {
  Leadership hung(false, 10);
  hung.step(kStart, 0);
  hung.step(kStart + milliseconds(500), 0);
  hung.hear_of(2);  // back from a hang: vehicles follow whoever took over
  EXPECT_FALSE(hung.step(kStart + milliseconds(600), 0));
  EXPECT_FALSE(hung.step(kStart + milliseconds(700), 1));
  EXPECT_FALSE(hung.step(kStart + milliseconds(9000), 1));
  hung.hear(2, 11);
  EXPECT_TRUE(hung.step(kStart + milliseconds(9100), 1));
  EXPECT_EQ(hung.role(), Role::kStandby);
}

}  // namespace
}  // namespace aisle::fleet
