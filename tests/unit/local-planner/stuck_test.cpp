// How long the vehicle stands with a reason to move.
#include "services/local-planner/core/stuck.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class StuckSince : public testing::Test {
 protected:
  StuckSince() { stuck.begin(kStart); }

  /// Tries at each of so many seconds. @returns when it should back off first; -1: never
  int backs_off_after(int most_s) {
    for (int s = 0; s <= most_s; ++s)
      if (stuck.has_tried_enough({10.0}, at_s(s))) return s;
    return -1;
  }

  Stuck stuck;
};

TEST_F(StuckSince, CountsFromWhenItLastMovedOrHadNoReasonTo) {
  EXPECT_DOUBLE_EQ(stuck.stood_s(at_s(2.0)), 2.0);
  stuck.move(at_s(2.0));
  EXPECT_DOUBLE_EQ(stuck.stood_s(at_s(3.0)), 1.0);
  stuck.rest(at_s(4.0));
  EXPECT_DOUBLE_EQ(stuck.stood_s(at_s(4.5)), 0.5);
}

TEST_F(StuckSince, BacksOffOnceItHasTriedForLongEnough) {
  const int first_s = backs_off_after(30);
  EXPECT_GE(first_s, 3);
  EXPECT_LE(first_s, 10);
  EXPECT_FALSE(stuck.has_tried_enough({10.0}, at_s(first_s + 1))) << "once";
}

TEST_F(StuckSince, PeopleWhoRefuseEverySpeedAreLetPassForAWhile) {
  for (int s = 0; s < 10; ++s) {
    stuck.notice_people(true, at_s(s));
    EXPECT_FALSE(stuck.has_tried_enough({10.0}, at_s(s))) << s;
  }
  bool backs_off = false;
  for (int s = 10; s < 30 && !backs_off; ++s) {
    stuck.notice_people(true, at_s(s));  // they do not walk by: they stay
    backs_off = stuck.has_tried_enough({10.0}, at_s(s));
  }
  EXPECT_TRUE(backs_off);
}

TEST_F(StuckSince, WaitingForAVehicleIsNoTry) {
  Attempt waits{10.0};
  waits.waits = true;
  for (int s = 0; s < 30; ++s) EXPECT_FALSE(stuck.has_tried_enough(waits, at_s(s)));
}

}  // namespace
}  // namespace aisle::local_planner
