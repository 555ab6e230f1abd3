#include "common/scenario/scenario_clock.hpp"

#include <gtest/gtest.h>

#include "common/time/stamp.hpp"

namespace aisle::scenario {
namespace {

using std::chrono::seconds;
constexpr std::int64_t kSecondNs = 1000000000;

TEST(ScenarioClock, StartsWhenTheLastVehicleIsHeard) {
  ScenarioClock clock({"a", "b"}, std::nullopt);
  clock.vehicle_heard("a", seconds(1), 101 * kSecondNs);
  clock.vehicle_heard("stranger", seconds(2), 102 * kSecondNs);
  EXPECT_FALSE(clock.seconds(seconds(3), 103 * kSecondNs).has_value());
  EXPECT_EQ(clock.missing(), std::vector<std::string>{"b"});
  clock.vehicle_heard("b", seconds(4), 104 * kSecondNs);
  EXPECT_DOUBLE_EQ(clock.seconds(seconds(9), 109 * kSecondNs).value(), 5.0);
}

TEST(ScenarioClock, HearingAVehicleAgainChangesNothing) {
  ScenarioClock clock({"a"}, std::nullopt);
  clock.vehicle_heard("a", seconds(1), 101 * kSecondNs);
  clock.vehicle_heard("a", seconds(5), 105 * kSecondNs);
  EXPECT_DOUBLE_EQ(clock.seconds(seconds(6), 106 * kSecondNs).value(), 5.0);
}

TEST(ScenarioClock, GoesOnAfterARestartWhereItWas) {
  ScenarioClock before({"a"}, std::nullopt);
  before.vehicle_heard("a", seconds(1), 101 * kSecondNs);
  ScenarioClock after({"a"}, before.started_at_ns());
  EXPECT_DOUBLE_EQ(after.seconds(seconds(30), 131 * kSecondNs).value(), 30.0);
}

TEST(ScenarioClock, AJumpOfTheWallClockDoesNotMoveTheRun) {
  ScenarioClock clock({"a"}, 100 * kSecondNs);
  EXPECT_DOUBLE_EQ(clock.seconds(seconds(1), 101 * kSecondNs).value(), 1.0);
  EXPECT_DOUBLE_EQ(clock.seconds(seconds(2), 3700 * kSecondNs).value(), 2.0);
}

TEST(ScenarioClock, CountsDownToAStartToCome) {
  ScenarioClock clock({"a"}, 105 * kSecondNs);
  EXPECT_DOUBLE_EQ(clock.seconds(seconds(1), 101 * kSecondNs).value(), -4.0);
}

}  // namespace
}  // namespace aisle::scenario
