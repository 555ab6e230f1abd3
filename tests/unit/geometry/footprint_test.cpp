#include "common/geometry/footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace aisle::geometry {
namespace {

const Footprint kForklift = rectangle(2.4, 1.1, 0.45);

TEST(Footprint, ItsReachIsItsFarthestCorner) {
  EXPECT_DOUBLE_EQ(reach_m(disc(0.35)), 0.35);
  EXPECT_DOUBLE_EQ(reach_m(kForklift), std::hypot(1.65, 0.55));
  EXPECT_DOUBLE_EQ(reach_m(rectangle(2.4, 1.1, -0.45)), std::hypot(1.65, 0.55));
}

TEST(Footprint, TheBodyLiesAheadOfTheFrame) {
  const Body body = body_of(kForklift, {1.0, 2.0, kPi / 2});
  EXPECT_NEAR(body.base_in_map.x, 1.0, 1e-12);
  EXPECT_NEAR(body.base_in_map.y, 2.45, 1e-12);
  EXPECT_NEAR(distance_m(body, {1.0, 2.0 + 1.65 + 0.5}), 0.5, 1e-12);
  EXPECT_NEAR(distance_m(body, {1.0, 2.0 - 0.75 - 0.5}), 0.5, 1e-12);
}

TEST(CoveringDiscs, OfADiscAreTheDisc) {
  const CoveringDiscs discs = covering_discs(disc(0.4));
  EXPECT_EQ(discs.radius_m, 0.4);
  EXPECT_EQ(discs.ahead_m, std::vector<double>{0.0});
}

TEST(CoveringDiscs, HoldAllOfARectangleAndLittleMore) {
  for (const Footprint& footprint :
       {kForklift, rectangle(0.8, 0.6), rectangle(1.0, 1.0, 0.1), rectangle(3.0, 0.8, -1.0)}) {
    const CoveringDiscs discs = covering_discs(footprint);
    EXPECT_GE(discs.ahead_m.size(), 3U);
    EXPECT_LE(discs.ahead_m.size(), 5U);
    for (double x = -0.5; x <= 0.5; x += 0.01)
      for (double y = -0.5; y <= 0.5; y += 0.01) {
        const Point2 p{footprint.ahead_m + x * footprint.length_m, y * footprint.width_m};
        const bool is_held = std::any_of(discs.ahead_m.begin(), discs.ahead_m.end(), [&](double ahead) {
          return distance({ahead, 0.0}, p) <= discs.radius_m + 1e-9;
        });
        ASSERT_TRUE(is_held) << p.x << ", " << p.y;
      }
    EXPECT_LT(discs.radius_m, 0.5 * footprint.width_m + 0.15);
  }
}

}  // namespace
}  // namespace aisle::geometry
