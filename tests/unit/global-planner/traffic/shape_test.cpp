#include "services/global-planner/core/traffic/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "common/geometry/body.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "tests/unit/global-planner/traffic/random_shape.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

Kind cart() { return {}; }

Kind forklift() {
  Kind kind;
  kind.footprint = geometry::rectangle(2.4, 1.1, 0.4);
  kind.tube_m = 0.12;
  kind.turning_radius_m = 0.6;
  return kind;
}

/// Metres from the point to the shape; 0 within.
double distance_m(const Shape& shape, Point2 p) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Capsule& c : shape.capsules())
    least_m = std::min(least_m, geometry::distance_to_segment(p, c.from_in_map, c.to_in_map) - c.radius_m);
  return std::max(0.0, least_m);
}

/// The gap by brute force: along the spines of one shape, in `pieces`, the nearest of the other.
double sampled_gap_m(const Shape& a, const Shape& b, int pieces) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Capsule& c : a.capsules()) {
    for (int i = 0; i <= pieces; ++i) {
      const Point2 p = c.from_in_map + (static_cast<double>(i) / pieces) * (c.to_in_map - c.from_in_map);
      for (const Capsule& d : b.capsules())
        least_m =
            std::min(least_m, geometry::distance_to_segment(p, d.from_in_map, d.to_in_map) - c.radius_m - d.radius_m);
    }
  }
  return std::max(0.0, least_m);
}

/// Points on the outline, wider by `wider_m` to all sides.
std::vector<Point2> outline(const Kind& kind, const Pose2& base_in_map, double wider_m) {
  std::vector<Point2> out;
  const double l = 0.5 * kind.footprint.length_m;
  const double w = 0.5 * kind.footprint.width_m;
  for (int i = 0; i < 360; i += 5) {
    const double angle = i * geometry::kPi / 180.0;
    const Point2 direction{std::cos(angle), std::sin(angle)};
    const double r = kind.footprint.is_disc() ? kind.footprint.radius_m : 0.0;
    const double x = kind.footprint.ahead_m + std::copysign(l, direction.x);
    out.push_back(to_map(base_in_map, Point2{x, std::copysign(w, direction.y)} + (r + wider_m) * direction));
  }
  return out;
}

void expect_inside(const Shape& shape, const Kind& kind, const Pose2& base_in_map) {
  for (const Point2 p : outline(kind, base_in_map, kind.tube_m)) ASSERT_LE(distance_m(shape, p), 1e-9);
}

TEST(Gap, IsThatOfTheNearestPoints) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    const Shape a = random_shape(random, 4.0);
    const Shape b = random_shape(random, 4.0);
    const double gap_m = gap_between_m(a, b);

    ASSERT_NEAR(gap_m, gap_between_m(b, a), 1e-12);
    const double sampled_m = sampled_gap_m(a, b, 400);
    ASSERT_LE(gap_m, sampled_m + 1e-12);
    ASSERT_GE(gap_m, sampled_m - 2.0 / 400);
  }
}

TEST(Gap, OfShapesThatCrossIsNone) {
  const Shape a({{{-1.0, 0.0}, {1.0, 0.0}, 0.0}});
  const Shape b({{{0.0, -1.0}, {0.0, 1.0}, 0.0}});
  EXPECT_EQ(gap_between_m(a, b), 0.0);
  EXPECT_TRUE(meet(a, b, 1e-6));
}

TEST(Gap, OfNothingIsInfinite) {
  EXPECT_EQ(gap_between_m(Shape(), Shape({{{0, 0}, {1, 0}, 1}})), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(meet(Shape(), Shape({{{0, 0}, {1, 0}, 1}}), 1.0));
}

TEST(Meet, AgreesWithTheGap) {
  std::mt19937 random(11);
  int met = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Shape a = random_shape(random, 5.0);
    const Shape b = random_shape(random, 5.0);
    const bool expected = gap_between_m(a, b) < 0.05 - 1e-9;
    ASSERT_EQ(meet(a, b, 0.05), expected);
    met += expected ? 1 : 0;
  }
  EXPECT_GT(met, 1'000);
  EXPECT_LT(met, 19'000);
}

TEST(Meet, NeighboursAtExactlyTheGapDoNot) {
  const double pitch_m = 2.0 * (0.35 + 0.10) + 0.05;
  for (int i = 0; i < 100; ++i) {
    const Shape a = standing_shape(cart(), {i * pitch_m, 0.3, 0.0});
    const Shape b = standing_shape(cart(), {(i + 1) * pitch_m, 0.3, 0.0});
    ASSERT_FALSE(meet(a, b, 0.05));
    ASSERT_TRUE(meet(a, b, 0.0501));
  }
}

TEST(Box, HoldsTheShape) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    Shape shape = random_shape(random, 4.0);
    shape.add(random_shape(random, 4.0));
    for (const Capsule& c : shape.capsules()) {
      for (const Point2 p : {c.from_in_map, c.to_in_map}) {
        ASSERT_LE(shape.low_in_map().x, p.x - c.radius_m);
        ASSERT_LE(shape.low_in_map().y, p.y - c.radius_m);
        ASSERT_GE(shape.high_in_map().x, p.x + c.radius_m);
        ASSERT_GE(shape.high_in_map().y, p.y + c.radius_m);
      }
    }
  }
}

TEST(StandingShape, HoldsTheOutlineWithItsTube) {
  for (const double yaw : {-2.0, 0.0, 0.7, 3.0}) {
    expect_inside(standing_shape(cart(), {1.0, 2.0, yaw}), cart(), {1.0, 2.0, yaw});
    expect_inside(standing_shape(forklift(), {1.0, 2.0, yaw}), forklift(), {1.0, 2.0, yaw});
  }
}

TEST(StandingShape, OfARectangleThatTurnsHoldsEveryHeading) {
  Kind kind;
  kind.footprint = geometry::rectangle(0.9, 0.6, 0.1);
  const Shape shape = standing_shape(kind, {1.0, 2.0, 0.0});
  for (double yaw = -3.0; yaw < 3.0; yaw += 0.25) expect_inside(shape, kind, {1.0, 2.0, yaw});
}

// The arc of a corner: a circle that touches both legs `reach_m` from the corner.
void expect_arc_inside(const Shape& shape, const Kind& kind, Point2 before, Point2 corner, Point2 after,
                       double reach_m) {
  const Point2 in = (1.0 / distance(before, corner)) * (corner - before);
  const Point2 out = (1.0 / distance(corner, after)) * (after - corner);
  const double turn = std::atan2(cross(in, out), dot(in, out));
  const double radius_m = reach_m / std::tan(0.5 * std::abs(turn));
  const double side = turn > 0.0 ? 1.0 : -1.0;
  const Point2 centre = corner - reach_m * in + side * radius_m * Point2{-in.y, in.x};

  for (int i = 0; i <= 20; ++i) {
    const double yaw = std::atan2(in.y, in.x) + turn * i / 20.0;
    const Point2 p = centre - side * radius_m * Point2{-std::sin(yaw), std::cos(yaw)};
    expect_inside(shape, kind, {p.x, p.y, yaw});
  }
}

TEST(SweptShape, HoldsTheArcsOfCornersWithin) {
  const Point2 corner{2.0, 0.0};
  for (double turn = -3.0; turn < 3.05; turn += 0.1) {
    const Point2 after = corner + 1.5 * Point2{std::cos(turn), std::sin(turn)};
    if (std::abs(turn) < 0.05) continue;

    expect_arc_inside(swept_shape(cart(), {{0.0, 0.0}, corner, after}), cart(), {0.0, 0.0}, corner, after, 0.5);
    const Point2 near = corner + 0.6 * Point2{std::cos(turn), std::sin(turn)};
    expect_arc_inside(swept_shape(cart(), {{0.0, 0.0}, corner, near}), cart(), {0.0, 0.0}, corner, near, 0.3);
  }
}

TEST(SweptShape, OfASmallVehicleHoldsTheArcsAsWell) {
  Kind kind;
  kind.footprint = geometry::disc(0.02);
  kind.tube_m = 0.0;
  const Point2 corner{2.0, 0.0};
  const Point2 after{2.0, 2.0};
  expect_arc_inside(swept_shape(kind, {{0.0, 0.0}, corner, after}), kind, {0.0, 0.0}, corner, after, 0.5);
}

TEST(SweptShape, OfForkliftsHoldsEveryPoseOfStraightsAndArcs) {
  for (const double turn : {-1.5708, -0.4, 0.0, 0.4, 1.5708}) {
    for (const double speed : {2.0, -2.0}) {
      const Pose2 from{1.0, 2.0, 0.8};
      const Pose2 to = kinematics::advance(from, {speed, turn, 0.0}, 1.0);
      const Shape shape = swept_shape(forklift(), {from.position(), to.position()}, {from.yaw, to.yaw});
      for (int i = 0; i <= 40; ++i)
        expect_inside(shape, forklift(), kinematics::advance(from, {speed, turn, 0.0}, i / 40.0));
    }
  }
}

TEST(SweptShape, OfForkliftsIsNoMuchWiderThanTheVehicle) {
  const Shape shape = swept_shape(forklift(), {{0.0, 0.0}, {3.0, 0.0}}, {0.0, 0.0});
  EXPECT_NEAR(shape.high_in_map().y, 0.55 + 0.12 + 0.05, 0.01);
  EXPECT_LT(shape.high_in_map().x, 3.0 + 1.6 + 0.12 + 0.4);
}

TEST(SweptShape, BeginsAndEndsWithWhatIsHeldStanding) {
  const Shape swept = swept_shape(cart(), {{0.0, 0.0}, {1.0, 0.2}, {1.5, 1.0}});
  for (const Point2 end : {Point2{0.0, 0.0}, Point2{1.5, 1.0}}) expect_inside(swept, cart(), {end.x, end.y, 0.0});
}

TEST(SweptShape, HoldsTheFloorOfTheVehicleThatStandsAtItsEnd) {
  const auto expect_end_inside = [](const Kind& kind, const std::vector<Point2>& path,
                                    const std::vector<double>& yaws) {
    const Shape shape = swept_shape(kind, path, yaws);
    const Pose2 end{path.back().x, path.back().y, yaws.empty() ? 0.0 : yaws.back()};
    const Shape at_end = standing_shape(kind, end);
    for (const Capsule& standing : at_end.capsules()) {
      const auto holds = [&](const Capsule& swept) { return is_inside(standing, swept); };
      EXPECT_TRUE(std::any_of(shape.capsules().begin(), shape.capsules().end(), holds));
    }
  };

  expect_end_inside(cart(), {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, {});
  expect_end_inside(forklift(), {{0.0, 0.0}, {1.0, 0.0}}, {0.0, 0.0});
  expect_end_inside(forklift(), {{1.0, 0.0}, {0.0, 0.0}}, {0.0, 0.0});
  expect_end_inside(forklift(), {{0.0, 0.0}, {2.0, 2.0}}, {0.0, 0.5 * geometry::kPi});
}

TEST(CornerShape, HoldsTheArcBetweenTwoSteps) {
  const Point2 corner{2.0, 0.0};
  const Point2 after{2.0, 1.0};
  Shape shape = swept_shape(cart(), {{0.0, 0.0}, corner});
  shape.add(swept_shape(cart(), {corner, after}));
  shape.add(corner_shape(cart(), {0.0, 0.0}, corner, after));
  expect_arc_inside(shape, cart(), {0.0, 0.0}, corner, after, 0.5);
}

TEST(CornerShape, OneDiscHoldsAllOfAPlace) {
  const Point2 corner{1.0, 2.0};
  const Shape all = all_corners_shape(cart(), corner);
  ASSERT_EQ(all.capsules().size(), 1U);

  for (int eighth = 1; eighth < 8; ++eighth) {
    const double yaw = eighth * geometry::kPi / 4.0;
    const Point2 after = corner + 3.0 * Point2{std::cos(yaw), std::sin(yaw)};
    const Shape arc = corner_shape(cart(), {-2.0, 2.0}, corner, after);
    for (const Capsule& chord : arc.capsules()) {
      for (const Point2 end : {chord.from_in_map, chord.to_in_map})
        EXPECT_LE(geometry::distance(corner, end) + chord.radius_m, all.capsules().front().radius_m + 1e-9);
    }
  }

  EXPECT_TRUE(all_corners_shape(forklift(), corner).empty());
}

TEST(CornerShape, IsEmptyWhereTheWayIsStraightOrTheVehicleDrivesItsOwnArcs) {
  EXPECT_TRUE(corner_shape(cart(), {0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}).empty());
  EXPECT_TRUE(corner_shape(forklift(), {0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}).empty());
  EXPECT_FALSE(corner_shape(cart(), {0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}).empty());
}

TEST(Kinds, AreEqualByAllTheyHold) {
  EXPECT_TRUE(cart() == cart());
  EXPECT_FALSE(cart() == forklift());
  Kind slow = cart();
  slow.limits.max_speed_mps = 0.7;
  EXPECT_FALSE(cart() == slow);
}

}  // namespace
}  // namespace aisle::global_planner::traffic
