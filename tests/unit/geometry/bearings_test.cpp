#include "common/geometry/bearings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

#include "common/geometry/wide_vectors.hpp"

namespace aisle::geometry {
namespace {

TEST(Bearings, AreThoseOfTheStandardLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-3.0, 3.0), exponent(-12.0, 12.0);
  for (int round = 0; round < 100000; ++round) {
    Wide x, y, found_rad;
    for (std::size_t i = 0; i < kWide; ++i)
      x[i] = coordinate(random), y[i] = coordinate(random) * (round % 2 == 0 ? 1.0 : std::pow(10.0, exponent(random)));
    find_bearing_rad(y, x, found_rad);
    for (std::size_t i = 0; i < kWide; ++i) {
      double alone_rad;
      find_bearing_rad<double>(y[i], x[i], alone_rad);
      ASSERT_EQ(found_rad[i], alone_rad);
      ASSERT_NEAR(alone_rad, std::atan2(y[i], x[i]), 1e-15) << y[i] << " " << x[i];
    }
  }
}

TEST(Bearings, OfTheAxesAndOfNothingAreExact) {
  for (const double y : {0.0, 1.0, -1.0})
    for (const double x : {0.0, 1.0, -1.0}) {
      double found_rad;
      find_bearing_rad(y, x, found_rad);
      EXPECT_EQ(found_rad, std::atan2(y, x)) << y << " " << x;
    }
}

}  // namespace
}  // namespace aisle::geometry
