#include "tools/lab/traffic/standoffs.hpp"

#include <gtest/gtest.h>

namespace aisle::lab {
namespace {

Doing standing(std::vector<std::string> waits_for) { return {true, false, false, std::move(waits_for), "floor held"}; }

TEST(StandoffWatch, TwoThatWaitForEachOtherStandOff) {
  StandoffWatch watch;
  for (double now_s = 0.0; now_s <= 6.0; now_s += 0.5)
    watch.look(now_s, {{"a", standing({"b"})}, {"b", standing({"a"})}});

  EXPECT_DOUBLE_EQ(watch.longest_standoff().seconds, 6.0);
  EXPECT_EQ(watch.longest_standoff().cause, "floor held b");
  EXPECT_DOUBLE_EQ(watch.longest_wait().seconds, 6.0);
}

TEST(StandoffWatch, AChainThatEndsAtOneWhoMovesIsAWaitOnly) {
  StandoffWatch watch;
  for (double now_s = 0.0; now_s <= 6.0; now_s += 0.5)
    watch.look(now_s, {{"a", standing({"b"})}, {"b", standing({"c"})}, {"c", {true, true, false, {}, ""}}});

  EXPECT_DOUBLE_EQ(watch.longest_standoff().seconds, 0.0);
  EXPECT_DOUBLE_EQ(watch.longest_wait().seconds, 6.0);
}

TEST(StandoffWatch, AVehicleThatIsHeldExcusesThoseBehindIt) {
  StandoffWatch watch;
  for (double now_s = 0.0; now_s <= 6.0; now_s += 0.5)
    watch.look(now_s, {{"a", standing({"b"})}, {"b", {true, false, true, {}, ""}}});

  EXPECT_DOUBLE_EQ(watch.longest_standoff().seconds, 0.0);
}

TEST(StandoffWatch, AVehicleThatStandsForNoReasonStandsOff) {
  StandoffWatch watch;
  watch.look(0.0, {{"a", standing({})}});
  watch.look(4.0, {{"a", standing({})}});

  EXPECT_DOUBLE_EQ(watch.longest_standoff().seconds, 4.0);
}

}  // namespace
}  // namespace aisle::lab
