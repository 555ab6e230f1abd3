#include "services/local-planner/core/lane.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kRadius = 0.35;

TEST(Lane, BeginsAndEndsWhereThePlanDoes) {
  const grid::ClearanceField clearance(aisle(3.0));
  const std::vector<Point2> plan{{1.0, 5.0}, {19.0, 5.3}};
  const Route lane = make_lane(plan, clearance, kRadius, {}).route;
  EXPECT_EQ(lane.points().front(), plan.front());
  EXPECT_EQ(lane.points().back(), plan.back());
}

TEST(Lane, IsThePlanWhereItIsStraight) {
  const grid::ClearanceField clearance(aisle(3.0));
  const Route lane = make_lane({{1.0, 5.3}, {19.0, 5.3}}, clearance, kRadius, {}).route;
  for (const Point2 p : lane.points()) EXPECT_NEAR(p.y, 5.3, 1e-9);
}

TEST(Lane, KnowsHowFarAlongThePlanItsPointsLie) {
  const grid::ClearanceField clearance(hall(20.0, 20.0));
  const Lane lane = make_lane({{3.0, 3.0}, {15.0, 3.0}, {15.0, 15.0}}, clearance, kRadius, {});
  EXPECT_LT(lane.route.length_m(), 24.0) << "rounded";
  EXPECT_NEAR(lane.left_m(0.0), lane.route.length_m(), 1e-9);
  EXPECT_NEAR(lane.left_m(20.0), 4.0, 0.05);
  EXPECT_NEAR(lane.left_m(24.0), 0.0, 1e-9);
}

TEST(RoundedLane, HasArcsTangentToBothLegs) {
  const Lane lane = rounded_lane({{{0.0, 0.0}, 0.0}, {{4.0, 0.0}, 0.5}, {{4.0, 4.0}, 0.0}, {{8.0, 4.0}, 0.0}});
  const Point2 centre{3.5, 0.5};
  int on_arc = 0;
  for (const Point2 p : lane.route.points()) {
    if (p.x < 3.5 - 1e-9 || p.y > 0.5 + 1e-9) continue;
    EXPECT_NEAR(geometry::distance(p, centre), 0.5, 1e-9) << p.x << " " << p.y;
    ++on_arc;
  }
  EXPECT_GE(on_arc, 8);
  EXPECT_NEAR(lane.route.length_m(), 12.0 - 1.0 + 0.25 * geometry::kPi, 0.01);
  const Point2 sharp = lane.route.at(lane.route.length_m() - lane.left_m(8.0));
  EXPECT_NEAR(sharp.x, 4.0, 1e-9);
  EXPECT_NEAR(sharp.y, 4.0, 1e-9);
}

TEST(RoundedLane, TurnsToTheRightAsWell) {
  const Lane lane = rounded_lane({{{0.0, 0.0}, 0.0}, {{4.0, 0.0}, 0.5}, {{4.0, -4.0}, 0.0}});
  const Point2 middle = lane.route.at(lane.route.length_m() - lane.left_m(4.0));
  EXPECT_NEAR(geometry::distance(middle, {4.0, 0.0}), arc_off_turn_m(0.5, 0.5 * geometry::kPi), 1e-3);
}

TEST(Lane, NeverComesNearerToWallsThanThePlanOrItsMargin) {
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  block(grid, 4.0, 0.0, 8.0, 7.0);
  const grid::ClearanceField clearance(grid);
  const std::vector<Point2> plan{{2.0, 2.0}, {3.55, 7.45}, {8.45, 7.45}, {10.0, 2.0}};
  double plan_least = 1e9;
  for (const Point2 p : resample(plan, 0.05)) plan_least = std::min(plan_least, clearance.clearance_m(p));
  const Route lane = make_lane(plan, clearance, kRadius, {}).route;
  for (double s = 0.0; s < lane.length_m(); s += 0.02)
    EXPECT_GE(clearance.clearance_m(lane.at(s)), std::min(plan_least, kRadius + LaneSettings{}.margin_m) - 0.05)
        << lane.at(s).x << " " << lane.at(s).y;
}

TEST(Lane, HasNoFoldsAtSharpTurns) {
  const grid::ClearanceField clearance(hall(20.0, 20.0));
  const Route lane = make_lane({{3.0, 3.0}, {15.0, 3.0}, {15.0, 15.0}, {4.0, 14.0}}, clearance, kRadius, {}).route;
  for (double s = 0.4; s + 0.4 < lane.length_m(); s += 0.1) {
    const double turn = std::abs(geometry::wrap(lane.heading_at(s + 0.2) - lane.heading_at(s - 0.2)));
    EXPECT_LT(turn, 1.2) << "at " << lane.at(s).x << " " << lane.at(s).y;
  }
}

TEST(SpeedProfile, StopsAtTheEndAndSlowsInBendsAndNearWalls) {
  grid::OccupancyGrid grid = hall(20.0, 10.0);
  block(grid, 8.0, 0.0, 12.0, 4.5);
  block(grid, 8.0, 5.5, 12.0, 10.0);
  const grid::ClearanceField clearance(grid);
  const Route route(resample({{1.0, 5.0}, {17.0, 5.0}}, 0.2));
  const auto speed = speed_profile(route, clearance, kRadius, {});
  const auto at = [&](double x) { return speed[static_cast<std::size_t>((x - 1.0) / 0.2)]; };
  EXPECT_DOUBLE_EQ(speed.back(), 0.0);
  EXPECT_DOUBLE_EQ(at(4.0), 1.2);
  EXPECT_LT(at(10.0), 0.8);
  ProfileLimits only_stops;
  only_stops.slows_on_the_way = false;
  const auto unslowed = speed_profile(route, clearance, kRadius, only_stops);
  EXPECT_DOUBLE_EQ(unslowed[45], 1.2);  // at x = 10
  EXPECT_DOUBLE_EQ(unslowed.back(), 0.0);
  const Route corner(resample({{2.0, 2.0}, {5.0, 2.0}, {5.0, 8.0}}, 0.2));
  const auto in_bend = speed_profile(corner, clearance, kRadius, {});
  EXPECT_LT(*std::min_element(in_bend.begin() + 12, in_bend.begin() + 18), 0.5);
}

TEST(SpeedProfile, DoesNotSlowDownBesideATurnThatIsMadeOnTheSpot) {
  const grid::ClearanceField clearance(hall(20.0, 10.0));
  const Route corner = rounded_lane({{{2.0, 2.0}, 0.0}, {{5.0, 2.0}, 0.0}, {{5.0, 8.0}, 0.0}}).route;
  ProfileLimits limits;
  EXPECT_LT(speed_profile(corner, clearance, kRadius, limits)[14], 0.5);
  limits.stops_at_turns = true;
  EXPECT_DOUBLE_EQ(speed_profile(corner, clearance, kRadius, limits)[14], 1.2);
  const Route rounded = rounded_lane({{{2.0, 2.0}, 0.0}, {{5.0, 2.0}, 0.5}, {{5.0, 8.0}, 0.0}}).route;
  EXPECT_LT(speed_profile(rounded, clearance, kRadius, limits)[15], 0.5) << "an arc is a bend";
}

TEST(Lane, KeepsAwayFromWallsThatWouldSlowItDown) {
  const grid::ClearanceField clearance(aisle(3.0));
  const Route lane = make_lane({{1.0, 3.96}, {19.0, 3.96}}, clearance, kRadius, {}).route;
  EXPECT_GT(clearance.clearance_m(lane.at(0.5 * lane.length_m())), kRadius + 0.25);
}

TEST(Lane, KeepsToThePlanBesideWallsThatDoNotSlowItDown) {
  const grid::ClearanceField clearance(aisle(3.0));
  LaneSettings settings;
  settings.roomy_m = 0.0;
  const Route lane = make_lane({{1.0, 3.96}, {19.0, 3.96}}, clearance, kRadius, settings).route;
  EXPECT_NEAR(lane.at(0.5 * lane.length_m()).y, 3.96, 1e-6);
}

TEST(SpeedProfile, CanBeBrakedAlong) {
  const grid::ClearanceField clearance(hall(20.0, 10.0));
  const Route route(resample({{2.0, 2.0}, {8.0, 2.0}, {8.0, 8.0}, {15.0, 8.0}}, 0.2));
  const ProfileLimits limits;
  const auto speed = speed_profile(route, clearance, kRadius, limits);
  for (std::size_t i = 1; i < speed.size(); ++i) {
    const double ds = route.along_m(i) - route.along_m(i - 1);
    EXPECT_LE(speed[i - 1] * speed[i - 1] - speed[i] * speed[i], 2.0 * limits.comfort_mps2 * ds + 1e-9);
  }
}

}  // namespace
}  // namespace aisle::local_planner
