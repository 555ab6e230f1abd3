#include "tools/draw/zones.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/ascii_grid.hpp"
#include "tools/draw/colours.hpp"

namespace aisle::draw {
namespace {

using fleet::Zone;
using ::testing::HasSubstr;
using ::testing::Not;

Zone rectangle(const std::string& id, Zone::Kind kind) {
  return {id, kind, Zone::Shape::kRectangle, {{1.0, 1.0}, {3.0, 2.0}}};
}

Zone speed_zone() {
  Zone zone = rectangle("bend", Zone::Kind::kSpeed);
  zone.max_speed_mps = 0.4;
  return zone;
}

/// 10 px a metre, y from 0 to 10 m.
MapFrame frame() { return {{0.0, 0.0}, {10.0, 10.0}, 0.0, 0.0, 10.0}; }

TEST(Zones, AreDrawnWhereTheyLieWithTheirNames) {
  const std::string svg = zones_layer(frame(), {speed_zone()});

  EXPECT_THAT(svg, HasSubstr("M10.0 90.0L30.0 90.0L30.0 80.0L10.0 80.0z"));
  EXPECT_THAT(svg, HasSubstr("<title>speed zone bend, 0.4 m/s</title>"));
  EXPECT_THAT(svg, HasSubstr(">bend, 0.4 m/s</text>"));
}

TEST(Zones, OneWayHasAnArrowAlongItsDirection) {
  Zone up = rectangle("up", Zone::Kind::kOneWay);
  up.points_in_map = {{0.0, 0.0}, {6.0, 8.0}};
  up.direction_rad = 0.5 * geometry::kPi;

  // From 2.5 m below the middle (3, 4) to 2.5 m above it; in the picture upwards is less.
  EXPECT_THAT(zones_layer(frame(), {up}), HasSubstr("M30.0 85.0L30.0 35.0"));
}

TEST(Zones, LegendNamesTheKindsThatAreThere) {
  const std::string svg = zones_legend(0, 0, {speed_zone(), speed_zone(), rectangle("p", Zone::Kind::kParking)});

  EXPECT_THAT(svg, HasSubstr(">speed</text>"));
  EXPECT_THAT(svg, HasSubstr(">parking</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("keep-out")));
  EXPECT_EQ(zones_legend(0, 0, {}), "");
}

TEST(Zones, PictureHoldsTheMapAndItsZones) {
  const std::string svg = zones_picture(test_support::grid_from_text({"....", ".#.."}), {speed_zone()});

  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr(kWall));
  EXPECT_THAT(svg, HasSubstr("bend"));
}

}  // namespace
}  // namespace aisle::draw
