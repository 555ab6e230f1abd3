#include "tools/lab/tracking/smooth_walk.hpp"

#include <gtest/gtest.h>

namespace aisle::tracking {
namespace {

using geometry::Point2;
using Rows = std::vector<fake_world::RecordedPerson::Row>;

const Rows kZigzag{{0.0, {0.0, 0.0}}, {0.4, {0.5, 0.2}}, {0.8, {1.0, 0.0}}, {1.6, {1.3, 0.4}}, {2.0, {1.3, 0.4}}};

TEST(SmoothWalk, IsTheBSplineOfTheRows) {
  const SmoothWalk walk(kZigzag);
  EXPECT_LT(geometry::distance(walk.at(0.0)->position_in_map, {0.0, 0.0}), 1e-12);
  EXPECT_LT(geometry::distance(walk.at(2.0)->position_in_map, {1.3, 0.4}), 1e-12);
  EXPECT_LT(geometry::distance(walk.at(0.4)->position_in_map, {0.5, 0.8 / 6.0}), 1e-12);  // (a + 4 b + c) / 6
  EXPECT_LT(geometry::distance(walk.at(0.4)->velocity_in_map, {1.25, 0.0}), 1e-12);       // (c - a) / 0.8
  EXPECT_FALSE(walk.at(-0.01));
  EXPECT_FALSE(walk.at(2.01));
}

TEST(SmoothWalk, HasAVelocityThatIsItsDerivativeAndNeverJumps) {
  const SmoothWalk walk(kZigzag);
  constexpr double kStep_s = 1e-4;
  for (double t = kStep_s; t < 2.0 - kStep_s; t += 0.01) {
    const Point2 slope =
        (0.5 / kStep_s) * (walk.at(t + kStep_s)->position_in_map - walk.at(t - kStep_s)->position_in_map);
    EXPECT_LT(geometry::norm(slope - walk.at(t)->velocity_in_map), 2e-3) << t;
    EXPECT_LT(geometry::norm(walk.at(t + kStep_s)->velocity_in_map - walk.at(t - kStep_s)->velocity_in_map), 5e-3) << t;
  }
}

TEST(SmoothWalk, KeepsAnEvenPaceAndHurriesAsTold) {
  const Rows even{{0.0, {0.0, 0.0}}, {0.4, {0.6, 0.0}}, {0.8, {1.2, 0.0}}};
  EXPECT_NEAR(SmoothWalk(even).at(0.3)->velocity_in_map.x, 1.5, 1e-12);
  EXPECT_NEAR(SmoothWalk(even, 0.6).at(0.3)->velocity_in_map.x, 0.9, 1e-12);
  EXPECT_NEAR(SmoothWalk(even, 0.6).end_s(), 0.8 / 0.6, 1e-12);
}

TEST(SmoothWalk, StandsOnTheOnlyRowAndTakesNoMomentTwice) {
  EXPECT_EQ(SmoothWalk(Rows{{1.0, {2.0, 3.0}}}).at(1.0)->velocity_in_map.x, 0.0);
  EXPECT_NEAR(SmoothWalk(Rows{{0.0, {0.0, 0.0}}, {0.0, {9.0, 9.0}}, {1.0, {1.0, 0.0}}}).at(0.5)->position_in_map.x, 0.5,
              1e-12);
}

}  // namespace
}  // namespace aisle::tracking
