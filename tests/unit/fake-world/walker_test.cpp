#include "services/fake-world/core/walker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace aisle::fake_world {
namespace {

scenario::Mover along_x(bool loop) {
  scenario::Mover mover;
  mover.id = "walker";
  mover.speed_mps = 1.0;
  mover.loop = loop;
  mover.waypoints_in_map = {{0, 0}, {4, 0}, {4, 3}};
  return mover;
}

geometry::Body vehicle_at(double x, double y) {
  geometry::Body body;
  body.base_in_map = {x, y, 0.0};
  body.radius_m = 0.35;
  return body;
}

void walk(Walker& walker, double seconds, const std::vector<geometry::Body>& vehicles = {}) {
  for (int i = 0; i < std::lround(seconds * 50); ++i) walker.step(0.02, vehicles);
}

TEST(Walker, WalksItsWaypointsToAndFro) {
  Walker walker(along_x(true), {});
  walk(walker, 5.0);
  EXPECT_NEAR(walker.motion().position_in_map.x, 4.0, 1e-6);
  EXPECT_NEAR(walker.motion().position_in_map.y, 1.0, 1e-6);
  EXPECT_NEAR(walker.motion().velocity_in_map.y, 1.0, 1e-9);
  walk(walker, 4.0);  // at the end after 7 s, then back
  EXPECT_NEAR(walker.motion().position_in_map.y, 1.0, 1e-6);
  EXPECT_NEAR(walker.motion().velocity_in_map.y, -1.0, 1e-9);
  walk(walker, 5.0 + 1.0);
  EXPECT_NEAR(walker.motion().position_in_map.x, 1.0, 1e-6);
  EXPECT_GT(walker.motion().velocity_in_map.x, 0.0);
}

TEST(Walker, OnceOnlyStaysAtItsEnd) {
  Walker walker(along_x(false), {});
  walk(walker, 20.0);
  EXPECT_EQ(walker.motion().position_in_map, (geometry::Point2{4, 3}));
  EXPECT_EQ(walker.motion().velocity_in_map, (geometry::Point2{}));
}

TEST(Walker, TheCourteousStopShortOfAVehicleInTheirWay) {
  Walker walker(along_x(false), {});
  walk(walker, 10.0, {vehicle_at(3.0, 0.0)});
  const double gap_m = 3.0 - walker.motion().position_in_map.x - 0.25 - 0.35;
  EXPECT_GT(gap_m, Walker::kCourtesyM - 0.05);
  EXPECT_LT(gap_m, Walker::kCourtesyM + 0.05);
  walk(walker, 1.0);
  EXPECT_GT(walker.motion().position_in_map.x, 2.0) << "goes on when the way is free";
}

TEST(Walker, AVehicleBehindOrAsideHoldsNobodyUp) {
  Walker walker(along_x(false), {});
  walk(walker, 1.0, {vehicle_at(-0.5, 0.0), vehicle_at(2.0, 2.0)});
  EXPECT_NEAR(walker.motion().position_in_map.x, 1.0, 1e-6);
}

TEST(Walker, TurnsBackWhenItHasWaitedTooLong) {
  Walker walker(along_x(true), {});
  walk(walker, 1.6 + Walker::kPatienceS + 1.0, {vehicle_at(3.0, 0.0)});
  EXPECT_LT(walker.motion().velocity_in_map.x, 0.0);
}

TEST(Walker, TheOthersWalkOn) {
  scenario::Mover mover = along_x(false);
  mover.courteous = false;
  Walker walker(mover, {});
  walk(walker, 3.0, {vehicle_at(3.0, 0.0)});
  EXPECT_NEAR(walker.motion().position_in_map.x, 3.0, 1e-6);
}

void walk_among(Walker& walker, double seconds, const std::vector<Walker::Neighbour>& persons) {
  for (int i = 0; i < std::lround(seconds * 50); ++i) walker.step(0.02, {}, persons);
}

TEST(Walker, WaitsBehindAPersonThatStandsOnItsWay) {
  scenario::Mover mover = along_x(false);
  mover.courteous = false;
  Walker walker(mover, {});
  walk_among(walker, 10.0, {{{3.0, 0.0}, {}, 0.25}});
  const double gap_m = 3.0 - walker.motion().position_in_map.x - 2 * 0.25;
  EXPECT_GT(gap_m, 0.0);
  EXPECT_LE(gap_m, Walker::kPersonGapM);
  EXPECT_EQ(walker.motion().velocity_in_map, (geometry::Point2{}));
}

TEST(Walker, TurnsBackBeforeAPersonThatStandsOnItsWay) {
  Walker walker(along_x(true), {});
  walk_among(walker, 2.5 + Walker::kPatienceS + 1.0, {{{3.0, 0.0}, {}, 0.25}});
  EXPECT_LT(walker.motion().velocity_in_map.x, 0.0);
}

TEST(Walker, APersonBesideItsWayOrBehindHoldsNobodyUp) {
  Walker walker(along_x(false), {});
  walk_among(walker, 3.0, {{{-0.4, 0.0}, {}, 0.25}, {{2.0, 0.6}, {}, 0.25}, {{2.0, -0.6}, {}, 0.25, true}});
  EXPECT_NEAR(walker.motion().position_in_map.x, 3.0, 1e-6);
}

TEST(Walker, LetsAPersonPassThatGoesFirst) {
  Walker walker(along_x(false), {});
  Walker::Neighbour other{{2.0, -2.0}, {0.0, 1.0}, 0.25, true};  // at (2, 0) after 2 s, as the walker
  double least_m = 10.0;

  for (int i = 0; i < 200; ++i) {
    other.position_in_map.y += 0.02;
    walker.step(0.02, {}, {other});
    least_m = std::min(least_m, geometry::distance(walker.motion().position_in_map, other.position_in_map));
  }

  EXPECT_GE(least_m, 0.5);
  EXPECT_GT(walker.motion().position_in_map.x, 2.0) << "and goes on";
}

}  // namespace
}  // namespace aisle::fake_world
