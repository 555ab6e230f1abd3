// What a vehicle's outline touches on its way, and planning for rectangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "common/geometry/separation.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/refusal.hpp"
#include "services/global-planner/core/swept_outline.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/ascii_grid.hpp"
#include "tests/support/random_grid.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Body;
using geometry::Footprint;
using geometry::kPi;
using geometry::Point2;
using geometry::Pose2;

/// Squares that are not free, with a ring of them around the map.
std::vector<Body> squares_of(const grid::OccupancyGrid& grid) {
  std::vector<Body> squares;
  const grid::Geometry& g = grid.geometry();
  for (int y = -1; y <= g.height; ++y) {
    for (int x = -1; x <= g.width; ++x) {
      const Point2 center = g.center_in_map({x, y});
      if (!g.contains({x, y}) || !grid.is_free({x, y}))
        squares.push_back({Body::Shape::kRectangle, {center.x, center.y, 0.0}, 0.0, g.resolution_m, g.resolution_m});
    }
  }
  return squares;
}

double least_gap_m(const std::vector<Body>& squares, const Body& body) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Body& square : squares) least_m = std::min(least_m, geometry::separation_m(body, square));
  return least_m;
}

/// At so many poses on the way.
constexpr int kLooks = 100;

double least_gap_on_way_m(const std::vector<Body>& squares, const Footprint& footprint, const Pose2& from,
                          const Pose2& to) {
  double least_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kLooks; ++i) {
    const double part = static_cast<double>(i) / kLooks;
    const Pose2 pose{from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
                     from.yaw + part * geometry::wrap(to.yaw - from.yaw)};
    least_m = std::min(least_m, least_gap_m(squares, geometry::body_of(footprint, pose)));
  }
  return least_m;
}

struct Dice {
  std::mt19937 random;
  double between(double low, double high) {
    return low + (high - low) * test_support::random_between(random, 0, 1000000) * 1e-6;
  }
};

TEST(SweptOutline, TouchesWhatManyLooksAtTheRectangleSee) {
  int touched = 0;
  int passed = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Dice dice{std::mt19937(seed)};
    const grid::OccupancyGrid grid = test_support::random_cells(dice.random, 24, 24, 2, 0.25);
    const grid::ClearanceField field(grid, 1.0);
    const std::vector<Body> squares = squares_of(grid);
    const Footprint footprint =
        geometry::rectangle(dice.between(0.2, 1.6), dice.between(0.2, 0.8), dice.between(-0.5, 0.5));
    const Pose2 from{dice.between(0.5, 5.5), dice.between(0.5, 5.5), dice.between(-3.1, 3.1)};
    Pose2 to{dice.between(0.5, 5.5), dice.between(0.5, 5.5), dice.between(-3.1, 3.1)};
    const Point2 ahead = geometry::to_map(from, {dice.between(-1.0, 1.0), 0.0});
    if (seed % 3 == 0) to = {ahead.x, ahead.y, from.yaw};  // straight on or back
    if (seed % 3 == 1) to = {from.x, from.y, to.yaw};      // turns on the spot

    const double gap_m = least_gap_on_way_m(squares, footprint, from, to);
    const double between_looks_m =
        (geometry::distance(from.position(), to.position()) + kPi * geometry::reach_m(footprint)) / kLooks;
    const auto touch = touched_on_way(field, footprint, from, to);
    if (gap_m < -1e-4) {
      EXPECT_TRUE(touch) << "seed " << seed << " overlaps by " << -gap_m;
    }
    if (gap_m > between_looks_m) {
      EXPECT_FALSE(touch) << "seed " << seed << " keeps " << gap_m;
    }
    ++(touch ? touched : passed);
  }
  EXPECT_GT(touched, 40);
  EXPECT_GT(passed, 40);
}

TEST(SweptOutline, OfADiscIsRightToTheLastMicrometre) {
  const grid::ClearanceField field(
      test_support::grid_from_text({".......", ".......", "...#...", ".......", "......."}), 3.0);
  const auto keeps = [&](Point2 from, Point2 to, double radius_m) {
    return !square_near_line(field, from, to, radius_m);
  };
  EXPECT_TRUE(keeps({1.0, 1.0}, {6.0, 1.0}, 1.0)) << "touches the square below it, and the border";
  EXPECT_FALSE(keeps({1.0, 1.0}, {6.0, 1.0}, 1.0001));
  EXPECT_TRUE(keeps({4.0, 1.5}, {6.0, 3.5}, std::hypot(0.25, 0.25)));
  EXPECT_FALSE(keeps({4.0, 1.5}, {6.0, 3.5}, std::hypot(0.25, 0.25) + 1e-4));
  EXPECT_TRUE(keeps({2.501, 0.5}, {5.501, 3.5}, 0.0));
  EXPECT_FALSE(keeps({2.5, 0.5}, {5.5, 3.5}, 0.0)) << "no corner may be cut";
  EXPECT_FALSE(keeps({3.0, 0.5}, {3.0, 4.5}, 0.0)) << "nor an edge be followed";
  EXPECT_FALSE(keeps({1.0, 2.5}, {6.0, 2.5}, 0.0));
}

/// A gap of one metre between two racks, then a hall.
const std::vector<std::string> kGap{"..........", "..........", "..........", "...####...", "..........",
                                    "...####...", "..........", "..........", ".........."};

struct Hall {
  grid::ClearanceField clearance{test_support::grid_from_text(kGap), 6.0};
  std::string why_not(const Footprint& footprint, const std::vector<Point2>& path,
                      std::optional<double> start_yaw_rad = {}) const {
    PlannedPath plan;
    plan.waypoints_in_map = path;
    return why_not_drivable({clearance, path.front(), path.back()}, plan, {footprint, start_yaw_rad, {}});
  }
};

TEST(PathChecker, LetsARectangleThroughAGapThatItFits) {
  const Hall hall;
  const std::vector<Point2> through{{1.5, 4.5}, {8.5, 4.5}};
  EXPECT_EQ(hall.why_not(geometry::rectangle(2.4, 0.9), through), "");
  EXPECT_EQ(hall.why_not(geometry::rectangle(2.4, 1.0), through), "") << "may touch";
  EXPECT_EQ(hall.why_not(geometry::rectangle(2.4, 1.001), through),
            "lets the outline overlap an obstacle when the vehicle is at (8.500, 4.500)");
  EXPECT_NE(hall.why_not(geometry::rectangle(2.4, 0.9), {{1.5, 4.4}, {8.5, 4.4}}), "");
  EXPECT_NE(hall.why_not(geometry::rectangle(2.4, 0.9), {{1.5, 4.5}, {8.5, 4.6}}), "");
}

TEST(PathChecker, TurnsARectangleOnTheSpot) {
  const Hall hall;
  const Footprint long_one = geometry::rectangle(2.4, 0.9);
  EXPECT_EQ(hall.why_not(long_one, {{1.5, 2.0}, {1.5, 4.5}, {8.5, 4.5}}), "") << "before the gap";
  EXPECT_NE(hall.why_not(long_one, {{1.5, 4.5}, {4.5, 4.5}, {4.5, 4.6}}), "") << "within it";
  EXPECT_NE(hall.why_not(long_one, {{5.0, 4.5}, {8.5, 4.5}}, 0.5 * kPi), "") << "it stands across at the start";
  EXPECT_NE(hall.why_not(long_one, {{5.0, 4.5}, {8.5, 4.5}}, kPi), "")
      << "cannot turn about there, though it fits before and after";
  EXPECT_EQ(hall.why_not(long_one, {{8.4, 4.5}, {1.5, 4.5}}, 0.0), "");
}

TEST(PathChecker, KnowsWhereTheFrameLiesInTheRectangle) {
  const Hall hall;
  const std::vector<Point2> to_the_border{{4.0, 7.5}, {8.5, 7.5}};
  EXPECT_EQ(hall.why_not(geometry::rectangle(2.4, 0.9, -0.2), to_the_border), "");
  EXPECT_NE(hall.why_not(geometry::rectangle(2.4, 0.9, 0.5), to_the_border), "") << "leaves the map";
  EXPECT_EQ(hall.why_not(geometry::rectangle(2.4, 0.9, 0.5), {{4.0, 7.5}, {8.2, 7.5}}), "");
}

TEST(Rectangles, MayDriveWhatTheDiscDrivesInWhichTheyTurn) {
  int narrow_faults = 0;
  for (const Variant& variant : all_variants()) {
    const auto planner = variant.make();
    int found = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
      Dice dice{std::mt19937(seed)};
      const grid::ClearanceField clearance(test_support::random_blocks(dice.random, 80, 12, 8, 0.1), 2.0);
      const Footprint footprint =
          geometry::rectangle(dice.between(0.4, 1.2), dice.between(0.2, 0.6), dice.between(-0.2, 0.2));
      Problem problem{clearance,
                      {dice.between(0.0, 8.0), dice.between(0.0, 8.0)},
                      {dice.between(0.0, 8.0), dice.between(0.0, 8.0)},
                      geometry::reach_m(footprint)};
      const Outline outline{footprint, dice.between(-3.0, 3.0), dice.between(-3.0, 3.0)};
      if (const PlannedPath plan = planner->plan(problem, nullptr); plan.outcome == Outcome::kFound) {
        ++found;
        EXPECT_EQ(why_not_drivable(problem, plan, outline), "") << variant.name << ", seed " << seed;
      }
      problem.radius_m = 0.5 * footprint.width_m;
      const PlannedPath narrow = planner->plan(problem, nullptr);
      if (narrow.outcome == Outcome::kFound && !why_not_drivable(problem, narrow, outline).empty()) ++narrow_faults;
    }
    EXPECT_GE(found, 3) << variant.name;
  }
  EXPECT_GT(narrow_faults, 40) << "the rectangle is not looked at";
}

Problem for_forklift(const grid::ClearanceField& clearance, const Footprint& footprint, const Pose2& start,
                     const Pose2& goal) {
  const geometry::CoveringDiscs discs = geometry::covering_discs(footprint);
  Problem problem{clearance, start.position(), goal.position(), discs.radius_m};
  problem.steering = {1.2, start.yaw, goal.yaw, true, discs.ahead_m};
  return problem;
}

TEST(Hybrid, PlansForTheRectangleItself) {
  const auto planner = find_variant("hybrid")->make();
  const Footprint footprint = geometry::rectangle(2.0, 0.8, 0.5);
  int found = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(test_support::random_blocks(random, 120, 10, 12, 0.1), 3.0);
    const Problem problem = for_forklift(clearance, footprint, {1.5, 1.5, 0.5}, {10.0, 10.0, 0.8});
    const PlannedPath plan = planner->plan(problem, nullptr);
    if (plan.outcome != Outcome::kFound) continue;
    ++found;
    EXPECT_EQ(why_not_drivable(problem, plan, {footprint, {}, {}}), "") << "seed " << seed;
  }
  EXPECT_GE(found, 8);
}

TEST(Hybrid, DrivesThroughAnAisleInWhichTheVehicleCannotTurn) {
  const Hall hall;
  const Footprint footprint = geometry::rectangle(1.6, 0.5, 0.3);
  Problem problem = for_forklift(hall.clearance, footprint, {1.4, 4.5, 0.0}, {4.5, 4.5, 0.0});
  const PlannedPath plan = find_variant("hybrid")->make()->plan(problem, nullptr);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(why_not_drivable(problem, plan, {footprint, {}, {}}), "");
  problem.radius_m = geometry::reach_m(footprint);
  EXPECT_EQ(find_variant("direct")->make()->plan(problem, nullptr).outcome, Outcome::kGoalBlocked);
}

TEST(Hybrid, SaysWhereTheVehicleDoesNotFit) {
  const Hall hall;
  const Footprint footprint = geometry::rectangle(1.6, 0.5, 0.3);
  const auto planner = find_variant("hybrid")->make();
  const auto refusal = [&](const Pose2& start, const Pose2& goal, double turning_radius_m) {
    Problem problem = for_forklift(hall.clearance, footprint, start, goal);
    problem.steering.turning_radius_m = turning_radius_m;
    problem.steering.may_reverse = false;
    const RefusalReport report = explain(problem, planner->plan(problem, nullptr).outcome, nullptr);
    return std::string(name(report.refusal)) + ": " + report.line;
  };
  EXPECT_EQ(refusal({4.5, 4.5, 1.5}, {8.4, 4.5, 0.0}, 1.2),
            "start too tight: the vehicle does not fit at the start (4.50, 4.50) with its heading there");
  EXPECT_EQ(refusal({1.4, 4.5, 0.0}, {4.5, 4.5, 1.5}, 1.2),
            "goal too tight: the vehicle does not fit at the goal (4.50, 4.50) with its heading there");
  EXPECT_EQ(refusal({1.4, 7.5, 0.0}, {4.5, 4.5, kPi}, 9.0),
            "cannot steer: no way from (1.40, 7.50) to (4.50, 4.50) with a turning radius of 9.00 m was found, though "
            "a radius of 0.30 m fits through");
}

}  // namespace
}  // namespace aisle::global_planner
