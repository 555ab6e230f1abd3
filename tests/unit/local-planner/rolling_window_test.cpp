// WU section 4: the five cases whose answer is known.
#include "services/local-planner/core/rolling_window.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

/// A vehicle at (10, 10) that drives along x at 1 m/s, and one other.
Meeting meet(Point2 position, Point2 velocity, double window_m = 10.0) {
  static const grid::ClearanceField clearance(hall(20.0, 20.0));
  static const std::vector<PeerMotion> kNoPeers;
  const std::vector<Mover> movers{{position, velocity, 0.25, 0.1, 0.0}};
  return predict_meeting({clearance, {10.0, 10.0, 0.0}, {1.0, 0.0, 0.0}, 0.35, {}, 1.2, movers, kNoPeers}, window_m, 5.0);
}

TEST(ClosestApproach, HeadOnIsAtTheMiddle) {
  const Approach approach = closest_approach({4.0, 0.3}, {-2.0, 0.0}, 5.0);
  EXPECT_DOUBLE_EQ(approach.time_s, 2.0);
  EXPECT_DOUBLE_EQ(approach.distance_m, 0.3);
}

TEST(ClosestApproach, OfWhoMovesAwayIsNow) {
  EXPECT_DOUBLE_EQ(closest_approach({1.0, 0.0}, {0.5, 0.0}, 5.0).time_s, 0.0);
  EXPECT_DOUBLE_EQ(closest_approach({1.0, 0.0}, {0.5, 0.0}, 5.0).distance_m, 1.0);
}

TEST(ClosestApproach, WithoutRelativeMotionIsNow) { EXPECT_DOUBLE_EQ(closest_approach({0.0, 2.0}, {}, 5.0).distance_m, 2.0); }

TEST(ClosestApproach, EndsWithTheHorizon) {
  const Approach approach = closest_approach({10.0, 0.0}, {-1.0, 0.0}, 4.0);
  EXPECT_DOUBLE_EQ(approach.time_s, 4.0);
  EXPECT_DOUBLE_EQ(approach.distance_m, 6.0);
}

TEST(RollingWindow, AFastCrosserPassesAhead) { EXPECT_EQ(meet({13.0, 9.0}, {0.0, 1.5}).encounter, Encounter::kNone); }
TEST(RollingWindow, ASlowCrosserPassesBehind) { EXPECT_EQ(meet({12.0, 7.0}, {0.0, 0.4}).encounter, Encounter::kNone); }

TEST(RollingWindow, ACrosserOnCollisionCourseIsMet) {
  const Meeting meeting = meet({13.0, 7.0}, {0.0, 1.0});
  EXPECT_EQ(meeting.encounter, Encounter::kCrossing);
  EXPECT_NEAR(meeting.approach.time_s, 3.0, 1e-9);
  EXPECT_NEAR(meeting.at_in_map.x, 13.0, 1e-9);
  EXPECT_NEAR(meeting.at_in_map.y, 10.0, 1e-9);
}

TEST(RollingWindow, WhatStandsIsMetOnlyInFront) {
  EXPECT_EQ(meet({13.0, 10.2}, {}).encounter, Encounter::kStatic);
  EXPECT_EQ(meet({13.0, 11.0}, {}).encounter, Encounter::kNone);
  EXPECT_EQ(meet({7.0, 10.0}, {}).encounter, Encounter::kNone);
}

TEST(RollingWindow, TellsOncomingFromSlower) {
  EXPECT_EQ(meet({13.0, 10.0}, {-1.0, 0.0}).encounter, Encounter::kOncoming);
  EXPECT_EQ(meet({11.5, 10.0}, {0.4, 0.0}).encounter, Encounter::kOvertaking);
}

TEST(RollingWindow, WhoDrivesBesideAtTheSameSpeedIsNotMet) { EXPECT_EQ(meet({10.0, 11.0}, {1.0, 0.0}).encounter, Encounter::kNone); }
TEST(RollingWindow, EndsAtTheSensorsRange) { EXPECT_EQ(meet({13.0, 10.0}, {}, 2.5).encounter, Encounter::kNone); }

TEST(RollingWindow, TheSoonestIsTold) {
  static const grid::ClearanceField clearance(hall(20.0, 20.0));
  static const std::vector<PeerMotion> kNoPeers;
  const std::vector<Mover> movers{{{13.0, 10.0}, {}, 0.25, 0.1, 0.0}, {{13.0, 10.0}, {-1.0, 0.0}, 0.25, 0.1, 0.0}};
  EXPECT_EQ(predict_meeting({clearance, {10.0, 10.0, 0.0}, {1.0, 0.0, 0.0}, 0.35, {}, 1.2, movers, kNoPeers}, 10.0, 5.0).encounter, Encounter::kOncoming);
}

TEST(LocalSubTarget, IsTheGoalInsideTheWindowElseTheRoutesLastPointInIt) {
  const Route route({{0.0, 0.0}, {20.0, 0.0}});
  EXPECT_NEAR(local_sub_target(route, 2.0, {2.0, 0.0}, 10.0).x, 12.0, 0.21);
  EXPECT_EQ(local_sub_target(route, 15.0, {15.0, 0.0}, 10.0), (Point2{20.0, 0.0}));
}

}  // namespace
}  // namespace aisle::local_planner
