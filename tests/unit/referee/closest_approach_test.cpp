#include "tools/referee/core/closest_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace aisle::referee {
namespace {

using geometry::Pose2;

constexpr Shape kDisc{0.35, 0.0, 0.0};
constexpr Shape kPoint{0.0, 0.0, 0.0};

Motion stands(const Shape& shape, const Pose2& at) { return {shape, at, at}; }

TEST(ClosestApproach, OfStandingDiscsIsTheirGap) {
  const Approach approach = closest_approach(stands(kDisc, {0, 0, 0}), stands({0.25, 0, 0}, {3, 4, 1}));
  EXPECT_NEAR(approach.clearance_m, 5.0 - 0.6, 1e-12);
}

TEST(ClosestApproach, SeesDiscsThatCrossBetweenSamples) {
  // At right angles through the same point at the same time; at both ends they are 2.8 m apart.
  const Approach approach = closest_approach({kDisc, {-2, 0, 0}, {2, 0, 0}}, {kDisc, {0, -2, 0}, {0, 2, 0}});
  EXPECT_NEAR(approach.clearance_m, -0.7, 1e-12);
  EXPECT_NEAR(approach.at, 0.5, 1e-12);
}

TEST(ClosestApproach, KnowsThatTheyPassedTheCrossingOneAfterTheOther) {
  // The paths cross, but the second is 2 m from the crossing when the first is on it: apart by 2 / sqrt(2) at the
  // nearest.
  const Approach approach = closest_approach({kDisc, {-2, 0, 0}, {2, 0, 0}}, {kDisc, {0, -4, 0}, {0, 0, 0}});
  EXPECT_NEAR(approach.clearance_m, std::sqrt(2.0) - 0.7, 1e-12);
  EXPECT_NEAR(approach.at, 0.75, 1e-12);
}

TEST(ClosestApproach, SeesWhatTunnelsThrough) {
  const Approach approach = closest_approach({kPoint, {-50, 0.1, 0}, {50, 0.1, 0}}, stands({0.0, 0.5, 0.5}, {0, 0, 0}));
  EXPECT_LE(approach.clearance_m, 0.0);
  EXPECT_NEAR(approach.at, 0.4975, 1e-9);
}

TEST(ClosestApproach, MeasuresAGrazingPass) {
  const Approach misses = closest_approach({kDisc, {-3, 0.7001, 0}, {3, 0.7001, 0}}, stands(kDisc, {0, 0, 0}));
  const Approach grazes = closest_approach({kDisc, {-3, 0.6999, 0}, {3, 0.6999, 0}}, stands(kDisc, {0, 0, 0}));
  EXPECT_NEAR(misses.clearance_m, 1e-4, 1e-9);
  EXPECT_NEAR(grazes.clearance_m, -1e-4, 1e-9);
}

TEST(ClosestApproach, RoundsTheCornersOfARectangleForADisc) {
  // The disc passes a corner of a 2 x 1 rectangle on a diagonal.
  const Approach approach = closest_approach({kDisc, {1.5, 2.0, 0}, {3.0, 0.5, 0}}, stands({0.0, 2.0, 1.0}, {0, 0, 0}));
  EXPECT_NEAR(approach.clearance_m, std::sqrt(2.0) - 0.35, 1e-9);  // corner (1, 0.5) to the line x + y = 3.5
}

TEST(ClosestApproach, TurnsTheRectangleWithItsHeading) {
  const Shape plank{0.0, 2.0, 0.2};
  EXPECT_NEAR(closest_approach(stands(plank, {0, 0, 0}), stands(kPoint, {0, 0.6, 0})).clearance_m, 0.5, 1e-9);
  EXPECT_NEAR(closest_approach(stands(plank, {0, 0, geometry::kPi / 2}), stands(kPoint, {0.6, 0, 0})).clearance_m, 0.5,
              1e-9);
}

TEST(ClosestApproach, SeesAPlankThatSweepsByTurningOnly) {
  const Shape plank{0.0, 2.0, 0.1};
  const Approach approach = closest_approach({plank, {0, 0, -0.4}, {0, 0, 0.4}}, stands(kPoint, {0.9, 0, 0}));
  EXPECT_LE(approach.clearance_m, 0.0);
  EXPECT_NEAR(approach.at, 0.5, 0.1);
}

TEST(ClosestApproach, OfTwoRectanglesIsBetweenTheirEdges) {
  const Approach approach =
      closest_approach({{0.0, 1.0, 1.0}, {-5, 0.9, 0}, {5, 0.9, 0}}, stands({0.0, 1.0, 0.6}, {0, 0, 0}));
  EXPECT_NEAR(approach.clearance_m, 0.1, 1e-9);
}

double brute_force_m(const Motion& a, const Motion& b) {
  // Outlines as dense points at many moments: never below the truth, and close above it.
  double least = 1e18;
  const auto outline = [](const Motion& m, double share, int i) {
    const double yaw = m.begin.yaw + share * geometry::wrap(m.end.yaw - m.begin.yaw);
    const Pose2 pose{m.begin.x + share * (m.end.x - m.begin.x), m.begin.y + share * (m.end.y - m.begin.y), yaw};
    const double side = i % 4;
    const double along = (i / 4) / 24.0 - 0.5;
    const double l = m.shape.length_m, w = m.shape.width_m;
    const geometry::Point2 p = side == 0   ? geometry::Point2{along * l, w / 2}
                               : side == 1 ? geometry::Point2{along * l, -w / 2}
                               : side == 2 ? geometry::Point2{l / 2, along * w}
                                           : geometry::Point2{-l / 2, along * w};
    return geometry::to_map(pose, p);
  };
  for (int step = 0; step <= 60; ++step) {
    for (int i = 0; i < 100; ++i) {
      for (int j = 0; j < 100; ++j) {
        least = std::min(least, geometry::distance(outline(a, step / 60.0, i), outline(b, step / 60.0, j)));
      }
    }
  }
  return least - a.shape.radius_m - b.shape.radius_m;
}

TEST(ClosestApproach, IsNeverAboveAndCloselyBelowBruteForce) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-3.0, 3.0), turn(-0.3, 0.3), size(0.2, 1.2), heading(-3.1, 3.1);
    const auto motion = [&] {
      const Pose2 begin{place(random), place(random), heading(random)};
      return Motion{{0.1, size(random), size(random)},
                    begin,
                    {place(random), place(random), geometry::wrap(begin.yaw + turn(random))}};
    };
    const Motion a = motion();
    const Motion b = motion();
    const double said_m = closest_approach(a, b).clearance_m;
    const double tried_m = brute_force_m(a, b);
    EXPECT_LE(said_m, tried_m + 1e-9) << "seed " << seed;
    if (tried_m > 0.1) {
      EXPECT_GT(said_m, tried_m - 0.08) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace aisle::referee
