// The highest speed of a cycle: each bound by itself.
#include "services/local-planner/core/speed_policy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class SpeedCap : public testing::Test {
 protected:
  double cap() const {
    const Moment moment = stage.moment();
    const Way way = stage.straight_way();
    return speed_cap_mps({moment, way, stage.around, target, stop_at_m, is_in_tube}, settings);
  }
  static Mover mover(geometry::Point2 position, bool may_walk, bool has_walked) {
    Mover mover;
    mover.position_in_map = position;
    mover.may_walk = may_walk;
    mover.has_walked = has_walked;
    return mover;
  }

  Stage stage;
  Settings settings;
  geometry::Point2 target{5.0, 5.0};
  double stop_at_m{std::numeric_limits<double>::infinity()};
  bool is_in_tube{false};
};

TEST_F(SpeedCap, IsTheWaysProfileWhereNothingElseBounds) {
  EXPECT_NEAR(cap(), stage.straight_way().speed_at(0.0), 1e-9);
  EXPECT_GT(cap(), 0.9);
}

TEST_F(SpeedCap, BrakesInComfortBeforeWhereItMustStop) {
  stop_at_m = 0.5;
  EXPECT_NEAR(cap(), std::sqrt(2.0 * settings.comfort_mps2 * 0.48), 1e-9);
  stop_at_m = 0.0;
  EXPECT_EQ(cap(), 0.0);
}

TEST_F(SpeedCap, SlowsWhereTheTargetIsFarOffTheHeading) {
  target = {4.0, 6.0};
  const double full_mps = stage.inputs.vehicle->limits.max_speed_mps;
  EXPECT_NEAR(cap(), 0.8 * full_mps * std::cos(geometry::kPi / 4.0), 1e-9);
  target = {3.0, 6.0};
  EXPECT_NEAR(cap(), 0.2, 1e-9);
}

TEST_F(SpeedCap, IsCarefulWhileThePlanIsOfAnOlderMap) {
  stage.inputs.map_revision = 2;
  EXPECT_DOUBLE_EQ(cap(), settings.cautious_mps);
}

TEST_F(SpeedCap, BrakesInComfortBeforeASpeedZoneAndKeepsToItsSpeedInside) {
  fleet::Zone zone;
  zone.id = "zone";
  zone.kind = fleet::Zone::Kind::kSpeed;
  zone.max_speed_mps = 0.3;

  const double free_mps = cap();
  zone.points_in_map = {{4.02, 4.0}, {5.0, 6.0}};
  stage.inputs.zones = {zone};
  EXPECT_NEAR(cap(), std::sqrt(0.09 + 2.0 * settings.comfort_mps2 * 0.2), 1e-9) << "0.2 m are left";

  stage.inputs.zones[0].points_in_map = {{2.0, 4.0}, {4.0, 6.0}};
  EXPECT_DOUBLE_EQ(cap(), 0.3);
  stage.inputs.zones[0].points_in_map = {{3.0, 5.6}, {5.0, 7.0}};
  EXPECT_DOUBLE_EQ(cap(), free_mps) << "it drives past the zone";
}

TEST_F(SpeedCap, LeavesRoomToPeople) {
  stage.around.movers = {mover({5.0, 5.0}, true, false)};
  EXPECT_NEAR(cap(), 0.25 + 0.5 * (2.0 - 0.35 - 0.25 - 0.2), 1e-9);
  stage.around.movers[0].velocity_in_map = {-1.0, 0.0};
  EXPECT_NEAR(cap(), 0.25 + 0.5 * (1.0 - 0.35 - 0.25 - 0.2), 1e-9) << "where it will be in a second counts";
}

TEST_F(SpeedCap, CreepsBesideWhatStoodForLongOnlyWhereItOnceWalked) {
  stage.around.movers = {mover({3.0, 5.7}, false, false)};
  const double free_mps = cap();
  EXPECT_GT(free_mps, 0.9);
  stage.around.movers[0].has_walked = true;
  EXPECT_NEAR(cap(), kCreepMps, 1e-9);
}

TEST_F(SpeedCap, CountsNobodyWhoIsBehindAndStaysThere) {
  const double free_mps = cap();
  stage.around.movers = {mover({2.5, 5.3}, true, true), mover({2.8, 5.6}, false, true)};
  EXPECT_EQ(cap(), free_mps);
  stage.around.movers[0].velocity_in_map = {1.0, 0.0};
  EXPECT_LT(cap(), free_mps) << "it catches up";
  stage.around.movers = {mover({2.8, 5.6}, true, true)};
  EXPECT_LT(cap(), free_mps) << "beside the vehicle";
}

TEST_F(SpeedCap, BrakesInATubeBeforeWhereAWalkerComesToTheWay) {
  Mover walker = mover({4.2, 2.4}, true, true);
  walker.velocity_in_map = {0.0, 1.5};
  stage.around.movers = {walker};
  const double free_mps = cap();
  is_in_tube = true;
  const double stands_before_m = 1.2 - 0.35 - walker.radius_m - 0.4;
  EXPECT_NEAR(cap(), std::sqrt(2.0 * settings.comfort_mps2 * stands_before_m), 0.05);
  EXPECT_LT(cap(), free_mps);
  stage.around.movers[0].velocity_in_map = {0.0, -1.5};
  EXPECT_GT(cap(), free_mps) << "walks away";
}

TEST(ProfileLimits, WallsSlowDownLessInATube) {
  EXPECT_GT(profile_limits({}, {}, true).at_wall_mps, profile_limits({}, {}, false).at_wall_mps);
  EXPECT_GT(profile_limits({}, {}, true).gap_rate, profile_limits({}, {}, false).gap_rate);
}

TEST(ProfileLimits, BrakeNoHarderThanTheVehicleCan) {
  Settings settings;
  kinematics::Limits limits;
  settings.comfort_mps2 = 0.6;
  limits.max_deceleration_mps2 = 0.4;
  EXPECT_DOUBLE_EQ(profile_limits(limits, settings, false).comfort_mps2, 0.4);
}

}  // namespace
}  // namespace aisle::local_planner
