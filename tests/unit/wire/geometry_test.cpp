#include "common/wire/geometry.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/wire/origin.hpp"

namespace aisle::wire {
namespace {

TEST(GeometryCodec, DecodesWhatItEncodes) {
  Checks checks;
  const geometry::Pose2 pose = decode(encode(geometry::Pose2{1.5, -2.5, 3.0}), checks);
  EXPECT_EQ(pose.x, 1.5);
  EXPECT_EQ(pose.y, -2.5);
  EXPECT_EQ(pose.yaw, 3.0);
  EXPECT_EQ(decode(encode(geometry::Point2{4.0, 5.0}), checks), (geometry::Point2{4.0, 5.0}));
  const geometry::Twist2 twist = decode(encode(geometry::Twist2{0.5, -0.25, -0.125}), checks);
  EXPECT_EQ(twist.linear_mps, 0.5);
  EXPECT_EQ(twist.sideways_mps, -0.125);
  EXPECT_EQ(twist.angular_radps, -0.25);
  const fleet::Origin origin = decode(encode(fleet::Origin{"planner-1", 2, 3, 4, 5}), checks);
  EXPECT_EQ(origin.source_id, "planner-1");
  EXPECT_EQ(origin.boot_id, 2U);
  EXPECT_EQ(origin.epoch, 3U);
  EXPECT_EQ(origin.sequence_number, 4U);
  EXPECT_EQ(origin.stamp_ns, 5);
  EXPECT_TRUE(checks.ok()) << checks.reason();
}

TEST(GeometryCodec, WrapsTheHeading) {
  Checks checks;
  aisle::Pose sample;
  sample.yaw_rad(1.5 * geometry::kPi);
  EXPECT_NEAR(decode(sample, checks).yaw, -0.5 * geometry::kPi, 1e-12);
  EXPECT_NEAR(encode(geometry::Pose2{0.0, 0.0, -geometry::kPi}).yaw_rad(), geometry::kPi, 1e-12);
  EXPECT_TRUE(checks.ok());
}

TEST(GeometryCodec, RefusesNumbersThatNoSiteHas) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308, -1e7}) {
    aisle::Pose pose;
    pose.y_m(bad);
    Checks of_pose;
    decode(pose, of_pose, "goal_in_map");
    EXPECT_EQ(of_pose.reason().rfind("goal_in_map", 0), 0U) << bad << ": " << of_pose.reason();
    aisle::Twist twist;
    twist.angular_radps(bad);
    Checks of_twist;
    decode(twist, of_twist);
    EXPECT_FALSE(of_twist.ok()) << bad;
    aisle::Twist aside;
    aside.sideways_mps(bad);
    Checks of_aside;
    decode(aside, of_aside);
    EXPECT_FALSE(of_aside.ok()) << bad;
    aisle::Point point;
    point.x_m(bad);
    Checks of_point;
    decode(point, of_point);
    EXPECT_FALSE(of_point.ok()) << bad;
  }
}

TEST(GeometryCodec, RefusesAnOriginWithoutSourceOrNumber) {
  Checks nameless;
  decode(encode(fleet::Origin{"", 1, 1, 1, 1}), nameless);
  EXPECT_FALSE(nameless.ok());
  Checks unnumbered;
  decode(encode(fleet::Origin{"planner-1", 1, 1, 0, 1}), unnumbered);
  EXPECT_FALSE(unnumbered.ok());
}

}  // namespace
}  // namespace aisle::wire
