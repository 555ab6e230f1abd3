// Do two vehicles hold the same floor, by their own words?
#include "tools/referee/core/floor_watch.hpp"

#include <gtest/gtest.h>

namespace aisle::referee {
namespace {

using geometry::Pose2;

/// Two carts of 0.8 m x 0.5 m, whose roads cross at (5, 0).
class Crossing : public testing::Test {
 protected:
  Crossing() {
    for (const char* agv_id : {"agv-1", "agv-2"}) watch_.shape_seen(agv_id, {0.0, 0.8, 0.5}, 0.0);
  }

  void say_first(double t_s) { watch_.road_said("agv-1", {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, t_s); }
  void say_second(double t_s, double to_y) { watch_.road_said("agv-2", {{5.0, -4.0, 1.57}, {5.0, to_y, 1.57}}, t_s); }

  FloorWatch watch_;
};

TEST_F(Crossing, FloorThatBothHoldForASecondIsHeldTwice) {
  for (double t_s = 0.0; t_s < 1.5; t_s += 0.1) {
    say_first(t_s);
    say_second(t_s, 4.0);
  }

  ASSERT_EQ(watch_.violations().size(), 1U) << "it is told once";
  EXPECT_EQ(watch_.violations()[0].kind, AuthorityViolation::Kind::kFloorHeldTwice);
  EXPECT_EQ(watch_.violations()[0].agv_id, "agv-1");
  EXPECT_NE(watch_.violations()[0].text.find("agv-2"), std::string::npos);
  EXPECT_NEAR(watch_.violations()[0].t_s, 0.0, 1e-9);
}

TEST_F(Crossing, AVehicleThatStopsBeforeTheOthersRoadHoldsItsOwn) {
  for (double t_s = 0.0; t_s < 3.0; t_s += 0.1) {
    say_first(t_s);
    say_second(t_s, -0.7);
  }

  EXPECT_TRUE(watch_.violations().empty());
}

TEST_F(Crossing, AFrontThatReachesIntoTheOthersRoadCounts) {
  for (double t_s = 0.0; t_s < 1.5; t_s += 0.1) {
    say_first(t_s);
    say_second(t_s, -0.5);
  }

  EXPECT_EQ(watch_.violations().size(), 1U);
}

TEST_F(Crossing, AnOldWordOfAVehicleThatIsNotHeardProvesNothing) {
  say_first(0.0);
  for (double t_s = 0.1; t_s < 5.0; t_s += 0.1) say_second(t_s, 4.0);
  EXPECT_TRUE(watch_.violations().empty());

  watch_.road_said("agv-1", {{7.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, 5.0);
  say_second(5.1, 4.0);
  EXPECT_TRUE(watch_.violations().empty()) << "it had gone on meanwhile";
}

TEST_F(Crossing, AVehicleWithoutStepsHoldsNothing) {
  for (double t_s = 0.0; t_s < 3.0; t_s += 0.1) {
    say_first(t_s);
    watch_.road_said("agv-2", {}, t_s);
  }

  EXPECT_TRUE(watch_.violations().empty());
}

TEST_F(Crossing, ALongFrontOfAForkliftCounts) {
  watch_.shape_seen("agv-2", {0.0, 2.4, 0.9}, 0.8);
  for (double t_s = 0.0; t_s < 1.5; t_s += 0.1) {
    say_first(t_s);
    say_second(t_s, -1.5);
  }

  EXPECT_EQ(watch_.violations().size(), 1U) << "its front is 2.0 m before its base";
}

}  // namespace
}  // namespace aisle::referee
