// A vehicle in the loop that drives as far as it is granted, in its tube.
#include <gtest/gtest.h>

#include <algorithm>

#include "services/local-planner/core/route.hpp"
#include "tests/unit/local-planner/drive.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kTubeM = 0.1;

/// A step at each turning point.
void give_road(Drive& drive, const std::vector<Point2>& waypoints, double tube_m = kTubeM) {
  drive.give_plan(waypoints);
  Plan& plan = *drive.inputs.plan;
  plan.tube_m = tube_m;
  plan.step_ends_m.clear();
  for (std::size_t i = 1; i < waypoints.size(); ++i)
    plan.step_ends_m.push_back((i > 1 ? plan.step_ends_m.back() : 0.0) +
                               geometry::distance(waypoints[i - 1], waypoints[i]));
}

void grant(Drive& drive, std::uint64_t limit_step, const std::string& waits_for = {}) {
  Grant grant;
  grant.number = drive.inputs.grant ? drive.inputs.grant->number + 1 : 1;
  grant.plan_id = drive.inputs.plan->id;
  grant.limit_step = limit_step;
  if (!waits_for.empty()) grant.waits_for = {waits_for};
  drive.inputs.grant = grant;
}

/// A way as a roadmap has it: places a metre apart, turns of all kinds.
std::vector<Point2> lattice_way() {
  return {{3.0, 5.0}, {4.0, 5.0}, {5.0, 5.1}, {6.0, 5.0}, {6.9, 4.2}, {7.0, 3.2}, {8.0, 3.0}, {9.0, 3.0},
          {9.8, 3.8}, {9.9, 4.8}, {9.8, 5.8}, {8.8, 6.0}, {7.8, 6.1}, {7.8, 7.1}, {8.8, 7.2}, {9.8, 7.2}};
}

TEST(GrantedRoad, IsDrivenToItsEndAndNoFarther) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {9.0, 5.0}, {12.0, 5.0}});
  drive.run(0.5);
  EXPECT_EQ(drive.output.phase, Phase::kWaiting);
  EXPECT_EQ(drive.output.reason, Reason::kNoGrant);
  EXPECT_DOUBLE_EQ(drive.twist.linear_mps, 0.0);

  grant(drive, 2, "agv-7");
  double hardest = 0.0;
  double before = 0.0;
  ASSERT_TRUE(drive.until(20.0, [&] {
    hardest = std::max(hardest, (before - drive.twist.linear_mps) / 0.02);
    before = drive.twist.linear_mps;
    return drive.output.reason == Reason::kNoGrant && drive.base.x > 5.0;
  }));
  EXPECT_EQ(drive.output.phase, Phase::kWaiting);
  EXPECT_EQ(drive.output.detail, "for agv-7");
  EXPECT_LT(hardest, 0.8) << "in comfort";
  drive.run(2.0);
  EXPECT_LE(drive.base.x, 9.0);
  EXPECT_GT(drive.base.x, 8.9);
  EXPECT_EQ(drive.output.road.step_done, 2U);

  grant(drive, 3);
  EXPECT_TRUE(drive.until(20.0, Phase::kArrived));
  EXPECT_EQ(drive.output.road.step_done, 3U);
}

TEST(GrantedRoad, IsDrivenThroughWithoutAStopWhenMoreIsGrantedInTime) {
  Drive drive(hall(30.0, 10.0));
  std::vector<Point2> waypoints;
  for (double x = 3.0; x < 25.0; x += 1.0) waypoints.push_back({x, 5.0});
  give_road(drive, waypoints);
  double slowest = 2.0;
  ASSERT_TRUE(drive.until(40.0, [&] {
    const std::uint64_t wanted = std::min<std::uint64_t>(waypoints.size() - 1, drive.output.road.step_done + 4);
    if (!drive.inputs.grant || wanted > drive.inputs.grant->limit_step) grant(drive, wanted);
    if (drive.base.x > 5.0 && drive.base.x < 20.0) slowest = std::min(slowest, drive.twist.linear_mps);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(slowest, 1.0);
}

TEST(GrantedRoad, TheOutlineStaysInTheTubeWhereverTheWayTurns) {
  for (const std::uint64_t ahead : {1U, 2U, 4U}) {
    Drive drive(hall(20.0, 10.0));
    const std::vector<Point2> way = lattice_way();
    give_road(drive, way);
    double farthest = 0.0;
    const bool arrived = drive.until(120.0, [&] {
      const std::uint64_t wanted = std::min<std::uint64_t>(way.size() - 1, drive.output.road.step_done + ahead);
      if (!drive.inputs.grant || wanted > drive.inputs.grant->limit_step) grant(drive, wanted);
      farthest = std::max(farthest, drive.output.road.stray_m);
      EXPECT_LE(drive.output.road.step_done, drive.output.road.limit_step);
      return drive.output.phase == Phase::kArrived;
    });
    EXPECT_TRUE(arrived) << ahead << " ahead, at " << drive.base.x << " " << drive.base.y << " "
                         << name(drive.output.phase) << " " << drive.output.detail;
    EXPECT_LT(farthest, kTubeM) << ahead << " ahead";
  }
}

TEST(GrantedRoad, ATurnThatIsGrantedLateIsMadeAtItsPlace) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {6.0, 8.0}});
  grant(drive, 1);
  ASSERT_TRUE(drive.until(20.0, [&] { return drive.output.reason == Reason::kNoGrant && drive.base.x > 5.5; }));
  grant(drive, 2);
  double farthest = 0.0;
  EXPECT_TRUE(drive.until(20.0,
                          [&] {
                            farthest = std::max(farthest, drive.output.road.stray_m);
                            return drive.output.phase == Phase::kArrived;
                          }))
      << drive.base.x << " " << drive.base.y;
  EXPECT_LT(farthest, kTubeM);
}

TEST(GrantedRoad, OutAndBackIsDrivenInOrder) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {3.0, 5.0}, {3.0, 8.0}});
  grant(drive, 3);
  double most_x = 0.0;
  EXPECT_TRUE(drive.until(60.0, [&] {
    most_x = std::max(most_x, drive.base.x);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(most_x, 5.9);
}

TEST(GrantedRoad, WhatIsAskedBackWhileDrivingIsGivenWhereItCanStop) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {9.0, 5.0}, {12.0, 5.0}, {15.0, 5.0}});
  grant(drive, 4);
  ASSERT_TRUE(drive.until(20.0, [&] { return drive.base.x > 8.6; }));
  grant(drive, 1);
  drive.inputs.grant->gives_back = true;
  drive.cycle();
  EXPECT_EQ(drive.output.road.limit_step, 3U);
  EXPECT_EQ(drive.output.road.grant_number, 2U);
  EXPECT_TRUE(drive.stops_within(2.0));
  drive.run(0.2);
  EXPECT_EQ(drive.output.road.limit_step, drive.output.road.step_done) << "it stays here";
  EXPECT_LT(drive.base.x, 12.0);
  const double stood_at = drive.base.x;
  drive.run(2.0);
  EXPECT_NEAR(drive.base.x, stood_at, 1e-6);
}

TEST(GrantedRoad, WhatStandsInTheTubeIsToldWithItsPlaceAndNotDrivenAround) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {9.0, 5.0}, {12.0, 5.0}});
  grant(drive, 3);
  double stood_since = 0.0;
  ASSERT_TRUE(drive.until(20.0, [&] {
    drive.inputs.tracks = {drive.track({9.0, 5.2}, {}, true)};
    if (stood_since == 0.0 && drive.base.x > 5.0 && drive.twist.linear_mps < 0.01)
      stood_since = time::seconds(drive.now);
    return drive.output.phase == Phase::kBlocked;
  }));
  EXPECT_LT(time::seconds(drive.now) - stood_since, 2.3);
  EXPECT_TRUE(drive.output.road.wants_room);
  EXPECT_EQ(drive.output.reason, Reason::kObstacle);
  EXPECT_EQ(drive.output.blocked_at_in_map, (Point2{9.0, 5.2}));
  EXPECT_DOUBLE_EQ(drive.output.blocked_radius_m, 0.25);
  EXPECT_LT(drive.output.road.stray_m, kTubeM);
}

TEST(GrantedRoad, OnTheFreeFloorABoxIsDrivenAround) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {9.0, 5.0}, {12.0, 5.0}}, 0.0);
  grant(drive, 3);
  EXPECT_TRUE(drive.until(30.0, [&] {
    drive.inputs.tracks = {drive.track({8.0, 5.0}, {}, true)};
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_EQ(drive.output.road.step_done, 3U);
}

TEST(GrantedRoad, OnTheFreeFloorItHasALimitToo) {
  Drive drive(hall(20.0, 10.0));
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {9.0, 5.0}, {12.0, 5.0}}, 0.0);
  grant(drive, 2);
  drive.run(20.0);
  EXPECT_LE(drive.base.x, 9.0);
  EXPECT_GT(drive.base.x, 8.9);
  EXPECT_EQ(drive.output.reason, Reason::kNoGrant);
}

/// The road ends where the way turns back: the leg behind lies ahead of the vehicle once it has turned.
TEST(GrantedRoad, WhereTheWayTurnsBackItStaysAtItsLimit) {
  for (const double beside_m : {0.0, 0.06, 0.12, 0.2}) {
    Drive drive(hall(20.0, 10.0), {7.0, 5.0, 0.0});
    give_road(drive, {{7.0, 5.0}, {8.0, 5.0}, {9.0, 5.0}, {8.0, 5.0 + beside_m}, {7.0, 5.0 + beside_m}, {3.0, 5.0}});
    grant(drive, 2, "agv-2");
    ASSERT_TRUE(drive.until(20.0, [&] { return drive.output.road.step_done == 2U; }));

    double farthest_m = 0.0;
    drive.until(10.0, [&] {
      farthest_m = std::max(farthest_m, geometry::distance(drive.base.position(), {9.0, 5.0}));
      return false;
    });
    EXPECT_LT(farthest_m, 0.15) << beside_m;
  }
}

TEST(GrantedRoad, OutOfItsTubeItSaysSoAndComesBack) {
  Drive drive(hall(20.0, 10.0), {3.0, 5.3, 0.0});
  give_road(drive, {{3.0, 5.0}, {6.0, 5.0}, {9.0, 5.0}});
  grant(drive, 2);
  drive.run(0.1);
  EXPECT_EQ(drive.output.reason, Reason::kOffPath);
  EXPECT_NEAR(drive.output.road.stray_m, 0.3, 0.01);
  double most_off = 0.3;
  EXPECT_TRUE(drive.until(20.0, [&] {
    most_off = std::max(most_off, drive.output.road.stray_m);
    return drive.output.road.stray_m < kTubeM;
  }));
  EXPECT_LT(most_off, 0.31);
  EXPECT_TRUE(drive.until(30.0, Phase::kArrived));
}

TEST(GrantedRoad, EveryVariantDrivesIt) {
  for (const Variant& variant : all_variants()) {
    Drive drive(hall(20.0, 10.0), {3.0, 5.0, 0.0}, variant);
    const std::vector<Point2> way = lattice_way();
    give_road(drive, way);
    grant(drive, way.size() - 1);
    double farthest = 0.0;
    EXPECT_TRUE(drive.until(120.0,
                            [&] {
                              farthest = std::max(farthest, drive.output.road.stray_m);
                              return drive.output.phase == Phase::kArrived;
                            }))
        << variant.name << " at " << drive.base.x << " " << drive.base.y;
    EXPECT_LT(farthest, kTubeM) << variant.name;
  }
}

}  // namespace
}  // namespace aisle::local_planner
