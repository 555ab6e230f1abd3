#include "services/local-planner/core/lane.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kRadius = 0.35;

double y_in_the_middle(const Route& lane) { return lane.at(0.5 * lane.length_m()).y; }

TEST(Lane, BeginsAndEndsWhereThePlanDoes) {
  const grid::ClearanceField clearance(aisle(3.0));
  const std::vector<Point2> plan{{1.0, 5.0}, {19.0, 5.3}};
  const Route lane = make_lane(plan, clearance, kRadius, {});
  EXPECT_EQ(lane.points().front(), plan.front());
  EXPECT_EQ(lane.points().back(), plan.back());
}

TEST(Lane, KeepsToTheRightSoThatOppositeLanesPass) {
  for (const double width : {2.0, 2.5, 3.0, 5.0}) {
    const grid::ClearanceField clearance(aisle(width));
    const Route east = make_lane({{1.0, 5.0}, {19.0, 5.0}}, clearance, kRadius, {});
    const Route west = make_lane({{19.0, 5.0}, {1.0, 5.0}}, clearance, kRadius, {});
    EXPECT_LT(y_in_the_middle(east), 5.0) << width;
    EXPECT_GT(y_in_the_middle(west), 5.0) << width;
    EXPECT_GT(y_in_the_middle(west) - y_in_the_middle(east), 2.0 * kRadius + 0.15) << width;
  }
}

TEST(Lane, LiesInTheSameHalfWhereverThePlanRuns) {
  const grid::ClearanceField clearance(aisle(3.0));
  const double along_left = y_in_the_middle(make_lane({{1.0, 5.9}, {19.0, 5.9}}, clearance, kRadius, {}));
  const double along_right = y_in_the_middle(make_lane({{1.0, 4.1}, {19.0, 4.1}}, clearance, kRadius, {}));
  EXPECT_LT(along_left, 5.2);
  EXPECT_LT(along_right, 4.8);
}

TEST(Lane, RunsInTheMiddleWhereTwoCannotPass) {
  const grid::ClearanceField clearance(aisle(1.2));
  EXPECT_NEAR(y_in_the_middle(make_lane({{1.0, 4.9}, {19.0, 4.9}}, clearance, kRadius, {})), 5.0, 0.06);
}

TEST(Lane, NeverComesNearerToWallsThanThePlanOrItsMargin) {
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  block(grid, 4.0, 0.0, 8.0, 7.0);
  const grid::ClearanceField clearance(grid);
  const std::vector<Point2> plan{{2.0, 2.0}, {3.55, 7.45}, {8.45, 7.45}, {10.0, 2.0}};
  double plan_least = 1e9;
  for (const Point2 p : resample(plan, 0.05)) plan_least = std::min(plan_least, clearance.clearance_m(p));
  const Route lane = make_lane(plan, clearance, kRadius, {});
  for (double s = 0.0; s < lane.length_m(); s += 0.02)
    EXPECT_GE(clearance.clearance_m(lane.at(s)), std::min(plan_least, kRadius + LaneSettings{}.margin_m) - 0.05)
        << lane.at(s).x << " " << lane.at(s).y;
}

TEST(Lane, HasNoFoldsAtSharpTurns) {
  const grid::ClearanceField clearance(hall(20.0, 20.0));
  const Route lane = make_lane({{3.0, 3.0}, {15.0, 3.0}, {15.0, 15.0}, {4.0, 14.0}}, clearance, kRadius, {});
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
