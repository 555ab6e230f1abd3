#include "common/fleet/zone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace aisle::fleet {
namespace {

using geometry::Point2;

Zone rectangle() { return {"dock", Zone::Kind::kKeepOut, Zone::Shape::kRectangle, {{4.0, 1.0}, {2.0, 3.0}}}; }
Zone disc() { return {"pillar", Zone::Kind::kNoStopping, Zone::Shape::kDisc, {{5.0, 5.0}}, 2.0}; }

/// An L: the square from (0, 0) to (4, 4) without its upper right quarter.
Zone corner() {
  return {"corner",
          Zone::Kind::kParking,
          Zone::Shape::kPolygon,
          {{0.0, 0.0}, {4.0, 0.0}, {4.0, 2.0}, {2.0, 2.0}, {2.0, 4.0}, {0.0, 4.0}}};
}

/// The reason for which the zone is refused after the change.
std::string refusal_with(Zone zone, const std::function<void(Zone&)>& change) {
  change(zone);
  return refusal_of(zone);
}

TEST(Zone, KindsAreFoundByTheirNames) {
  for (const char* word : {"keep-out", "speed", "one-way", "no-stopping", "one-vehicle", "parking"}) {
    const auto kind = find_zone_kind(word);
    ASSERT_TRUE(kind) << word;
    EXPECT_STREQ(name(*kind), word);
  }

  EXPECT_FALSE(find_zone_kind("keepout"));
  EXPECT_FALSE(find_zone_kind(""));
}

TEST(Zone, SoundOnesOfEachShapeAreTaken) {
  EXPECT_EQ(refusal_of(rectangle()), "");
  EXPECT_EQ(refusal_of(disc()), "");
  EXPECT_EQ(refusal_of(corner()), "");
}

TEST(Zone, RefusalsNameTheFieldAndTheLimit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](const std::function<void(Zone&)>& change) { return refusal_with(rectangle(), change); };

  EXPECT_EQ(refusal([](Zone& z) { z.id = "a b"; }), "zone_id: use 1 to 60 letters, digits, '-', '_' and '.'");
  EXPECT_EQ(refusal([](Zone& z) { z.id.assign(61, 'a'); }), "zone_id: use 1 to 60 letters, digits, '-', '_' and '.'");
  EXPECT_EQ(refusal([](Zone& z) { z.points_in_map.pop_back(); }),
            "points: a rectangle has 2 opposite corners, this has 1");
  EXPECT_EQ(refusal([](Zone& z) { z.points_in_map[1].x = 4.0; }), "points: the rectangle has no area");
  EXPECT_EQ(refusal([&](Zone& z) { z.points_in_map[1].y = nan; }), "points: y = nan is not within -100000 and 100000");
  EXPECT_EQ(refusal([](Zone& z) { z.radius_m = 1.0; }), "radius_m: only a disc has one");
  EXPECT_EQ(refusal([](Zone& z) { z.max_speed_mps = 0.5; }), "max_speed_mps: only a speed zone has one");
  EXPECT_EQ(refusal([](Zone& z) { z.direction_rad = 0.5; }), "direction_rad: only a one-way zone has one");

  EXPECT_EQ(refusal([](Zone& z) { z.kind = Zone::Kind::kSpeed; }), "max_speed_mps = 0 is not within 0.05 and 10");
  EXPECT_EQ(refusal([&](Zone& z) {
              z.kind = Zone::Kind::kOneWay;
              z.direction_rad = nan;
            }),
            "direction_rad = nan is not within -6.3 and 6.3");

  EXPECT_EQ(refusal_with(disc(), [](Zone& z) { z.radius_m = 0.0; }), "radius_m = 0 is not above 0 and at most 100000");
  EXPECT_EQ(refusal_with(disc(), [&](Zone& z) { z.radius_m = nan; }),
            "radius_m = nan is not above 0 and at most 100000");
  EXPECT_EQ(refusal_with(corner(), [](Zone& z) { z.points_in_map.resize(2); }),
            "points: a polygon has 3 to 64 corners, this has 2");
  EXPECT_EQ(refusal_with(corner(), [](Zone& z) { z.points_in_map.resize(65); }),
            "points: a polygon has 3 to 64 corners, this has 65");
  EXPECT_EQ(refusal_with(corner(),
                         [](Zone& z) {
                           z.points_in_map = {{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}};
                         }),
            "points: the polygon has no area");
}

TEST(Zone, ContainsItsInsideAndItsEdge) {
  EXPECT_TRUE(contains(rectangle(), {3.0, 2.0}));
  EXPECT_TRUE(contains(rectangle(), {2.0, 2.0}));
  EXPECT_FALSE(contains(rectangle(), {1.99, 2.0}));

  EXPECT_TRUE(contains(corner(), {3.5, 1.0}));
  EXPECT_TRUE(contains(corner(), {1.0, 3.5}));
  EXPECT_FALSE(contains(corner(), {3.0, 3.0}));

  EXPECT_TRUE(contains(disc(), {7.0, 5.0}));
  EXPECT_FALSE(contains(disc(), {7.01, 5.0}));
}

TEST(Zone, DistanceOfASegmentIsThatOfItsNearestPoint) {
  EXPECT_DOUBLE_EQ(distance_m(rectangle(), {0.0, 2.0}, {1.0, 2.0}), 1.0);
  EXPECT_DOUBLE_EQ(distance_m(rectangle(), {5.0, 0.0}, {5.0, 4.0}), 1.0);  // nearest between its ends
  EXPECT_DOUBLE_EQ(distance_m(rectangle(), {0.0, 2.0}, {9.0, 2.0}), 0.0);  // right through
  EXPECT_DOUBLE_EQ(distance_m(rectangle(), {2.5, 2.0}, {3.5, 2.0}), 0.0);  // all inside
  EXPECT_DOUBLE_EQ(distance_m(corner(), {3.0, 3.0}, {3.5, 3.5}), 1.0);     // in the notch
  EXPECT_DOUBLE_EQ(distance_m(disc(), {0.0, 8.0}, {9.0, 8.0}), 1.0);
  EXPECT_DOUBLE_EQ(distance_m(disc(), {0.0, 5.0}, {9.0, 5.0}), 0.0);
}

TEST(Zone, CornersOfADiscLieJustAroundIt) {
  const auto corners = corners_of(disc());
  ASSERT_EQ(corners.size(), 32U);

  for (const Point2 at : corners) {
    EXPECT_GT(geometry::distance(at, {5.0, 5.0}), 2.0);
    EXPECT_LT(geometry::distance(at, {5.0, 5.0}), 2.0 * 1.005);
  }
}

}  // namespace
}  // namespace aisle::fleet
