#include "services/local-planner/core/route.hpp"

#include <gtest/gtest.h>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

const Route kCorner({{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}});

TEST(Route, IsAddressedByArcLength) {
  EXPECT_DOUBLE_EQ(kCorner.length_m(), 7.0);
  EXPECT_NEAR(geometry::distance(kCorner.at(5.0), {4.0, 1.0}), 0.0, 1e-12);
  EXPECT_NEAR(kCorner.heading_at(1.0), 0.0, 1e-12);
  EXPECT_NEAR(kCorner.heading_at(6.0), geometry::kPi / 2, 1e-12);
}

TEST(Route, TakesTheNearerEndBeyondItsEnds) {
  EXPECT_EQ(kCorner.at(-1.0), (Point2{0.0, 0.0}));
  EXPECT_EQ(kCorner.at(99.0), (Point2{4.0, 3.0}));
}

TEST(Route, ProjectsToTheNearestPointOfTheStretch) {
  EXPECT_NEAR(kCorner.project({2.5, 0.7}, 0.0, 7.0), 2.5, 1e-12);
  EXPECT_NEAR(kCorner.project({4.4, 2.0}, 0.0, 7.0), 6.0, 1e-12);
  EXPECT_NEAR(kCorner.project({4.4, 2.0}, 0.0, 3.0), 3.0, 1e-12);  // no further than it was asked for
}

TEST(Route, DropsPointsThatRepeat) {
  const Route route({{1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}, {2.0, 1.0}});
  EXPECT_EQ(route.points().size(), 2U);
  EXPECT_DOUBLE_EQ(route.length_m(), 1.0);
}

TEST(Route, OfOnePointHasNoLength) {
  const Route route({{1.0, 2.0}});
  EXPECT_DOUBLE_EQ(route.length_m(), 0.0);
  EXPECT_EQ(route.at(0.5), (Point2{1.0, 2.0}));
  EXPECT_DOUBLE_EQ(route.project({5.0, 5.0}, 0.0, 1.0), 0.0);
}

TEST(Route, SplicesAHeadBeforeWhatIsLeft) {
  const Route spliced = kCorner.spliced({{1.0, 1.0}, {3.0, 1.0}}, 4.5);
  EXPECT_EQ(spliced.points().front(), (Point2{1.0, 1.0}));
  EXPECT_EQ(spliced.points().back(), (Point2{4.0, 3.0}));
  EXPECT_NEAR(geometry::distance(spliced.at(2.0 + std::hypot(1.0, 0.5)), {4.0, 0.5}), 0.0, 1e-9);
}

TEST(Resample, KeepsBothEndsAndTheSpacing) {
  const auto points = resample({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.05}}, 0.2);
  EXPECT_EQ(points.front(), (Point2{0.0, 0.0}));
  EXPECT_EQ(points.back(), (Point2{1.0, 1.05}));
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LE(geometry::distance(points[i - 1], points[i]), 0.2 + 1e-9);
}

}  // namespace
}  // namespace aisle::local_planner
