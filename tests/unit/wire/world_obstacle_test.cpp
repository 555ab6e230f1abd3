#include <gtest/gtest.h>

#include <limits>

#include "common/wire/vehicle.hpp"

namespace aisle::wire {
namespace {

fleet::Obstacle forklift() {
  fleet::Obstacle obstacle;
  obstacle.id = "forklift-1";
  obstacle.kind = fleet::Obstacle::Kind::kVehicle;
  obstacle.base_in_map = {3.0, 2.0, 0.5 * geometry::kPi};
  obstacle.footprint = geometry::rectangle(2.4, 1.1, 0.4);
  obstacle.velocity_in_map = {0.0, 1.0};
  return obstacle;
}

TEST(WorldObstacleCodec, DecodesWhatItEncodes) {
  const auto decoded = decode(encode(forklift()));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_EQ(decoded->kind, fleet::Obstacle::Kind::kVehicle);
  EXPECT_EQ(decoded->base_in_map.position(), (geometry::Point2{3.0, 2.0}));
  EXPECT_EQ(decoded->footprint.length_m, 2.4);
  EXPECT_EQ(decoded->footprint.ahead_m, 0.4);
  EXPECT_EQ(decoded->velocity_in_map, (geometry::Point2{0.0, 1.0}));
}

TEST(WorldObstacleCodec, PutsTheBodyWhereItsMiddleIs) {
  const auto decoded = decode(encode(forklift()));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_NEAR(decoded->body().base_in_map.x, 3.0, 1e-12);
  EXPECT_NEAR(decoded->body().base_in_map.y, 2.4, 1e-12);
}

TEST(WorldObstacleCodec, RefusesWhatNoThingIs) {
  aisle::WorldObstacle sample = encode(forklift());
  sample.ahead_m(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(decode(sample).reason().rfind("ahead_m", 0), 0U);
  sample = encode(forklift());
  sample.shape(static_cast<FootprintKind>(2));
  EXPECT_NE(decode(sample).reason(), "");
}

}  // namespace
}  // namespace aisle::wire
