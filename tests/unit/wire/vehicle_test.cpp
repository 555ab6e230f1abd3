#include "common/wire/vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

namespace aisle::wire {
namespace {

using geometry::Footprint;
using kinematics::Limits;
using kinematics::Model;

fleet::Vehicle forklift() {
  Limits limits{1.0, 0.4, 0.9, 0.5, 0.7, 2.0};
  limits.model = Model::kTricycle;
  limits.axle = {1.5, 1.1, 0.8, true};
  return {"forklift-1", geometry::rectangle(2.4, 1.1, 0.4), limits, 10.0, 0.2};
}
fleet::Vehicle cart() {
  Limits limits;
  limits.model = Model::kOmnidirectional;
  return {"cart-1", geometry::disc(0.35), limits, 8.0, 0.2};
}

TEST(VehicleInfoCodec, DecodesTheForkliftItEncodes) {
  const auto decoded = decode(encode(forklift()));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_EQ(decoded->id, "forklift-1");
  EXPECT_FALSE(decoded->footprint.is_disc());
  EXPECT_EQ(decoded->footprint.length_m, 2.4);
  EXPECT_EQ(decoded->footprint.width_m, 1.1);
  EXPECT_EQ(decoded->footprint.ahead_m, 0.4);
  const Limits& limits = decoded->limits;
  EXPECT_EQ(limits.model, Model::kTricycle);
  EXPECT_EQ(limits.max_speed_mps, 1.0);
  EXPECT_EQ(limits.max_reverse_mps, 0.4);
  EXPECT_EQ(limits.max_turn_radps, 0.9);
  EXPECT_EQ(limits.max_acceleration_mps2, 0.5);
  EXPECT_EQ(limits.max_deceleration_mps2, 0.7);
  EXPECT_EQ(limits.max_turn_acceleration_radps2, 2.0);
  EXPECT_EQ(limits.axle.wheelbase_m, 1.5);
  EXPECT_EQ(limits.axle.max_steering_rad, 1.1);
  EXPECT_EQ(limits.axle.max_steering_rate_radps, 0.8);
  EXPECT_TRUE(limits.axle.is_rear);
  EXPECT_EQ(decoded->sensor_range_m, 10.0);
  EXPECT_EQ(decoded->command_timeout_s, 0.2);
}

TEST(VehicleInfoCodec, DecodesTheOmnidirectionalDiscItEncodes) {
  const auto decoded = decode(encode(cart()));
  ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
  EXPECT_TRUE(decoded->footprint.is_disc());
  EXPECT_EQ(decoded->footprint.radius_m, 0.35);
  EXPECT_EQ(decoded->limits.model, Model::kOmnidirectional);
}

TEST(VehicleInfoCodec, SaysTheCircleAroundTheFrameThatHoldsARectangle) {
  EXPECT_NEAR(encode(forklift()).radius_m(), std::hypot(1.6, 0.55), 1e-12);
  EXPECT_EQ(encode(cart()).radius_m(), 0.35);
}

using Spoil = std::function<void(aisle::VehicleInfo&)>;

std::string refusal(const fleet::Vehicle& vehicle, const Spoil& spoil) {
  aisle::VehicleInfo sample = encode(vehicle);
  spoil(sample);
  return decode(sample).reason();
}

TEST(VehicleInfoCodec, RefusesWhatNoVehicleIs) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<const char*, Spoil> spoils[]{
      {"agv_id", [](auto& v) { v.agv_id(""); }},
      {"model", [](auto& v) { v.model(static_cast<KinematicModel>(3)); }},
      {"footprint", [](auto& v) { v.footprint(static_cast<FootprintKind>(7)); }},
      {"length_m", [](auto& v) { v.length_m(0.0); }},
      {"width_m", [=](auto& v) { v.width_m(nan); }},
      {"ahead_m", [=](auto& v) { v.ahead_m(nan); }},
      {"max_speed_mps", [](auto& v) { v.max_speed_mps(1e9); }},
      {"max_reverse_mps", [](auto& v) { v.max_reverse_mps(-0.1); }},
      {"max_turn_radps", [](auto& v) { v.max_turn_radps(0.0); }},
      {"max_acceleration_mps2", [](auto& v) { v.max_acceleration_mps2(0.0); }},
      {"max_deceleration_mps2", [](auto& v) { v.max_deceleration_mps2(0.0); }},
      {"max_turn_acceleration_radps2", [=](auto& v) { v.max_turn_acceleration_radps2(nan); }},
      {"sensor_range_m", [](auto& v) { v.sensor_range_m(-1.0); }},
      {"command_timeout_s", [=](auto& v) { v.command_timeout_s(nan); }},
      {"wheelbase_m", [](auto& v) { v.wheelbase_m(0.0); }},
      {"max_steering_rad", [](auto& v) { v.max_steering_rad(1.5708); }},
      {"max_steering_rate_radps", [](auto& v) { v.max_steering_rate_radps(-0.5); }},
  };
  for (const auto& [field, spoil] : spoils)
    EXPECT_EQ(refusal(forklift(), spoil).rfind(field, 0), 0U) << field << ": " << refusal(forklift(), spoil);
  EXPECT_EQ(refusal(forklift(), [](auto&) {}), "");
  EXPECT_EQ(refusal(cart(), [](auto& v) { v.radius_m(11.0); }).rfind("radius_m", 0), 0U);
}

/// A driver that knows nothing of the others' fields leaves them as they are.
TEST(VehicleInfoCodec, AsksForTheSteeredAxleOfATricycleOnly) {
  EXPECT_EQ(refusal(cart(), [](auto& v) { v.length_m(0.0); }), "");
  EXPECT_NE(refusal(cart(), [](auto& v) { v.model(KinematicModel::MODEL_TRICYCLE); }), "");
}

}  // namespace
}  // namespace aisle::wire
