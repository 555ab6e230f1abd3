// What is done to a batch is what is done to each of its numbers, to the bit: negative zeros, infinities and NaN
// included.
#include "common/geometry/batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace aisle::geometry {
namespace {

std::uint64_t bits_of(double a) {
  std::uint64_t bits;
  std::memcpy(&bits, &a, sizeof(bits));
  return bits;
}

double some_number(std::mt19937_64& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kSpecial[]{0.0, -0.0, kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN(), 1.0};
  if (random() % 4 == 0) return kSpecial[random() % 6];
  return std::uniform_real_distribution<double>(-3.0, 3.0)(random);
}

TEST(Batch, OperationsAreThoseOfEachNumber) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20000; ++round) {
    Batch a, b;
    for (std::size_t i = 0; i < kBatch; ++i) a[i] = some_number(random), b[i] = some_number(random);
    const Batch lesser = least(a, b), greater = most(a, b), bounded = clamped(a, -1.0, 1.0), size = magnitude(a),
                signed_as_b = with_sign(a, b), root = square_root(magnitude(a)), sum = 2.0 * a + b;
    bool is_any_less = false;
    for (std::size_t i = 0; i < kBatch; ++i) {
      ASSERT_EQ(bits_of(lesser[i]), bits_of(least<double>(a[i], b[i])));
      ASSERT_EQ(bits_of(greater[i]), bits_of(most<double>(a[i], b[i])));
      ASSERT_EQ(bits_of(bounded[i]), bits_of(clamped<double>(a[i], -1.0, 1.0)));
      ASSERT_EQ(bits_of(size[i]), bits_of(magnitude(a[i])));
      ASSERT_EQ(bits_of(signed_as_b[i]), bits_of(with_sign(a[i], b[i])));
      ASSERT_EQ(bits_of(root[i]), bits_of(square_root(magnitude(a[i]))));
      const double sum_alone = 2.0 * a[i] + b[i];
      ASSERT_TRUE(std::isnan(sum_alone) || bits_of(sum[i]) == bits_of(sum_alone));
      is_any_less = is_any_less || a[i] < b[i];
    }
    ASSERT_EQ(any(a < b), is_any_less);
  }
}

}  // namespace
}  // namespace aisle::geometry
