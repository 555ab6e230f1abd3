#include "common/fleet/coverage.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace aisle::fleet {
namespace {

using Rows = std::vector<std::string>;

const std::vector<std::uint8_t> kAges{0, 2, 3, 20, 254, 255};

TEST(CoveragePicture, LiesAsTheTileLiesInTheMap) { EXPECT_EQ(picture_of(kAges, 3, 2, 0.5), (Rows{"+. ", "##+"})); }

TEST(CoveragePicture, HasNoRowsForWhichAgesAreMissing) {
  EXPECT_EQ(picture_of(kAges, 3, 4000000000U, 0.5).size(), 2U);
  EXPECT_EQ(picture_of(kAges, 4, 2, 0.5).size(), 1U);
  EXPECT_TRUE(picture_of(kAges, 0, 2, 0.5).empty());
}

TEST(CoverageLetter, ChangesAfterOneSecondAndAfterTen) {
  EXPECT_EQ(letter_of_age(2, 0.5), '#');
  EXPECT_EQ(letter_of_age(3, 0.5), '+');
  EXPECT_EQ(letter_of_age(20, 0.5), '+');
  EXPECT_EQ(letter_of_age(21, 0.5), '.');
  EXPECT_EQ(letter_of_age(kSeenLongAgo, 1e-3), '.');
  EXPECT_EQ(letter_of_age(kNeverSeen, 1e-3), ' ');
}

}  // namespace
}  // namespace aisle::fleet
