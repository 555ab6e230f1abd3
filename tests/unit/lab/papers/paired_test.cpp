#include "tools/lab/papers/paired.hpp"

#include <gtest/gtest.h>

namespace aisle::lab {
namespace {

TEST(StudentT, IsAsInTheTables) {
  EXPECT_NEAR(student_t_975(1), 12.706, 0.001);
  EXPECT_NEAR(student_t_975(3), 3.182, 0.004);
  EXPECT_NEAR(student_t_975(9), 2.262, 0.001);
  EXPECT_NEAR(student_t_975(29), 2.045, 0.001);
  EXPECT_NEAR(student_t_975(199), 1.972, 0.001);
}

// Ten pairs of which the sums of ranks are known: differences 1, 2, ..., 10 with 3 and 5 negative.
TEST(PairedComparison, RanksSizesAndKeepsSigns) {
  const std::vector<double> a{0, 0, 3, 0, 5, 0, 0, 0, 0, 0};
  const std::vector<double> b{1, 2, 0, 4, 0, 6, 7, 8, 9, 10};
  const PairedComparison found = compare_pairs(a, b);
  EXPECT_EQ(found.n, 10U);
  EXPECT_NEAR(found.effect, (47.0 - 8.0) / 55.0, 1e-12);
  EXPECT_NEAR(found.wilcoxon_p, 0.0526, 0.0005) << "z = (47 - 27.5 - 0.5) / sqrt(96.25) = 1.9366";
  EXPECT_NEAR(found.mean_difference, 3.9, 1e-12);
}

TEST(PairedComparison, IntervalIsThatOfStudentsT) {
  const PairedComparison found = compare_pairs({0, 0, 0, 0, 0}, {1, 2, 3, 4, 5});
  EXPECT_NEAR(found.interval95[0], 3.0 - 2.776 * 0.70711, 0.002);
  EXPECT_NEAR(found.interval95[1], 3.0 + 2.776 * 0.70711, 0.002);
  EXPECT_TRUE(found.interval_excludes_zero());
}

TEST(PairedComparison, TiesShareTheirRankAndEqualPairsDoNotCount) {
  const PairedComparison found = compare_pairs({0, 0, 0, 7}, {2, -2, 2, 7});
  EXPECT_NEAR(found.effect, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(found.n, 4U);
}

TEST(PairedComparison, OfEqualSamplesFindsNothing) {
  const PairedComparison found = compare_pairs({1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(found.wilcoxon_p, 1.0);
  EXPECT_EQ(found.effect, 0.0);
  EXPECT_FALSE(found.interval_excludes_zero());
  EXPECT_EQ(compare_pairs({}, {}).n, 0U);
}

}  // namespace
}  // namespace aisle::lab
