#include "common/geometry/bearings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace aisle::geometry {
namespace {

TEST(Bearings, AreThoseOfTheStandardLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-3.0, 3.0), exponent(-12.0, 12.0);
  for (int round = 0; round < 100000; ++round) {
    Batch x, y;
    for (std::size_t i = 0; i < kBatch; ++i)
      x[i] = coordinate(random), y[i] = coordinate(random) * (round % 2 == 0 ? 1.0 : std::pow(10.0, exponent(random)));
    const Batch found_rad = bearing_rad(y, x);
    for (std::size_t i = 0; i < kBatch; ++i) {
      const double alone_rad = bearing_rad<double>(y[i], x[i]);
      ASSERT_EQ(found_rad[i], alone_rad);
      ASSERT_NEAR(alone_rad, std::atan2(y[i], x[i]), 1e-15) << y[i] << " " << x[i];
    }
  }
}

TEST(Bearings, OfTheAxesAndOfNothingAreExact) {
  for (const double y : {0.0, 1.0, -1.0})
    for (const double x : {0.0, 1.0, -1.0}) EXPECT_EQ(bearing_rad(y, x), std::atan2(y, x)) << y << " " << x;
}

}  // namespace
}  // namespace aisle::geometry
