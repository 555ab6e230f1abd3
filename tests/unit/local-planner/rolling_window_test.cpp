// WU section 4: the five cases whose answer is known.
#include "services/local-planner/core/rolling_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
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
  return predict_meeting({clearance, {10.0, 10.0, 0.0}, {1.0, 0.0, 0.0}, 0.35, {}, 1.2, movers, kNoPeers}, window_m,
                         5.0);
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

TEST(ClosestApproach, WithoutRelativeMotionIsNow) {
  EXPECT_DOUBLE_EQ(closest_approach({0.0, 2.0}, {}, 5.0).distance_m, 2.0);
}

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

TEST(RollingWindow, WhoDrivesBesideAtTheSameSpeedIsNotMet) {
  EXPECT_EQ(meet({10.0, 11.0}, {1.0, 0.0}).encounter, Encounter::kNone);
}
TEST(RollingWindow, EndsAtTheSensorsRange) { EXPECT_EQ(meet({13.0, 10.0}, {}, 2.5).encounter, Encounter::kNone); }

// WU eqs. 6 and 7: (v1 + v2) T < r.
TEST(RollingWindow, NothingCrossesItBetweenTwoLooks) {
  const Variant& wu = *find_variant("wu");
  constexpr double kFastestOtherMps = 10.0;
  EXPECT_LT((wu.paper.max_speed_mps + kFastestOtherMps) * wu.printed.interval_s, kWindowM);
}

TEST(RollingWindow, TheSoonestIsTold) {
  static const grid::ClearanceField clearance(hall(20.0, 20.0));
  static const std::vector<PeerMotion> kNoPeers;
  const std::vector<Mover> movers{{{13.0, 10.0}, {}, 0.25, 0.1, 0.0}, {{13.0, 10.0}, {-1.0, 0.0}, 0.25, 0.1, 0.0}};
  EXPECT_EQ(predict_meeting({clearance, {10.0, 10.0, 0.0}, {1.0, 0.0, 0.0}, 0.35, {}, 1.2, movers, kNoPeers}, 10.0, 5.0)
                .encounter,
            Encounter::kOncoming);
}

/// A vehicle at (3, 5) in a hall or an aisle of 20 m along x, that drives at 1 m/s towards a goal at (17, 5), or on
/// another route.
struct Drives {
  explicit Drives(const grid::OccupancyGrid& grid, std::vector<Point2> way = {{3.0, 5.0}, {17.0, 5.0}})
      : clearance(grid), route(resample(way, 0.2)) {}

  Room room() const { return {clearance, standing, 0.35, 0.02, 0.02}; }
  Scene scene(double yaw_rad = 0.0) const {
    return {clearance, {3.0, 5.0, yaw_rad}, {1.0, 0.0, 0.0}, 0.35, {}, 1.2, movers, peers};
  }
  std::optional<Point2> sub_target(double window_m = kWindowM) const {
    const Scene now = scene();
    const Room free = room();
    return local_sub_target({now, free, route, 0.0, window_m});
  }
  std::optional<Point2> avoidance() const {
    const Scene now = scene();
    const Room free = room();
    return avoid({now, free, route, 0.0}, {4.5, 5.0});
  }

  grid::ClearanceField clearance;
  Route route;
  std::vector<Disc> standing;
  std::vector<Mover> movers;
  std::vector<PeerMotion> peers;
};

constexpr double kNear = 0.25;

TEST(LocalSubTarget, IsTheGoalInsideTheWindow) {
  const auto target = Drives(hall(20.0, 10.0)).sub_target(15.0);
  ASSERT_TRUE(target);
  EXPECT_NEAR(geometry::distance(*target, {17.0, 5.0}), 0.0, kNear);
}

TEST(LocalSubTarget, IsTheBorderWhereTheRouteLeavesTheWindow) {
  const auto target = Drives(hall(20.0, 10.0)).sub_target(10.0);
  ASSERT_TRUE(target);
  EXPECT_NEAR(geometry::distance(*target, {13.0, 5.0}), 0.0, kNear);
}

TEST(LocalSubTarget, IsInSightWhereTheRouteBends) {
  grid::OccupancyGrid grid = hall(20.0, 10.0);
  block(grid, 0.0, 0.0, 20.0, 4.0);
  block(grid, 0.0, 6.0, 6.0, 10.0);
  block(grid, 8.0, 4.0, 20.0, 10.0);
  const Drives drives(grid, {{3.0, 5.0}, {7.0, 5.0}, {7.0, 9.0}});
  const auto target = drives.sub_target();
  ASSERT_TRUE(target);
  EXPECT_TRUE(drives.room().is_line_free({3.0, 5.0}, *target));
  EXPECT_GT(target->x, 6.0) << "as far as can be seen";
}

TEST(LocalSubTarget, IsBesideWhatStands) {
  Drives drives(hall(20.0, 10.0));
  drives.standing = {{{8.0, 5.0}, 0.5}};
  const auto target = drives.sub_target();
  ASSERT_TRUE(target);
  EXPECT_TRUE(drives.room().is_line_free({3.0, 5.0}, *target));
  EXPECT_GT(std::abs(target->y - 5.0), 0.5);
}

TEST(Avoid, KeepsToThePathWhereNobodyIsMet) {
  Drives drives(hall(20.0, 10.0));
  EXPECT_FALSE(drives.avoidance());
  drives.movers = {{{6.0, 4.0}, {0.0, 1.5}, 0.25, 0.1, 0.0}};  // passes ahead
  EXPECT_FALSE(drives.avoidance());
  drives.movers = {{{4.5, 5.0}, {0.4, 0.0}, 0.25, 0.1, 0.0}};  // slower
  EXPECT_FALSE(drives.avoidance());
}

TEST(Avoid, AimsWhereNobodyIsMet) {
  Drives drives(hall(20.0, 10.0));
  for (const Mover& other : {Mover{{7.0, 5.0}, {-1.0, 0.0}, 0.25, 0.1, 0.0},
                             Mover{{5.0, 3.0}, {0.0, 1.0}, 0.25, 0.1, 0.0}, Mover{{5.5, 5.1}, {}, 0.25, 0.1, 0.0}}) {
    drives.movers = {other};
    const auto target = drives.avoidance();
    ASSERT_TRUE(target);
    EXPECT_EQ(predict_meeting(drives.scene(geometry::bearing({3.0, 5.0}, *target)), kWindowM, kAvoidS).encounter,
              Encounter::kNone);
    EXPECT_GT(target->x, 3.5) << "goes on";
  }
}

TEST(Avoid, KeepsToThePathWhereThereIsNoRoomBeside) {
  Drives drives(aisle(1.0));
  drives.movers = {{{6.0, 5.0}, {-1.0, 0.0}, 0.25, 0.1, 0.0}};
  EXPECT_FALSE(drives.avoidance());
}

}  // namespace
}  // namespace aisle::local_planner
