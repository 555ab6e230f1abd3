#include "common/wire/checks.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>

#include "idl/map.hpp"

namespace aisle::wire {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Checks, PassWhatIsWithinItsBounds) {
  Checks checks;
  checks.finite("a", 1e308)
      .within("b", 0.0, 0.0, 1.0)
      .within("c", 1.0, 0.0, 1.0)
      .count("d", 3, 3, 3)
      .id("e", "agv-1")
      .holds(true, "f");
  EXPECT_EQ(checks.known("g", EditShape::SHAPE_DISC, std::optional(7)), 7);
  EXPECT_TRUE(checks.ok());
  EXPECT_EQ(checks.reason(), "");
}

TEST(Checks, NoNumberIsWithinNoBounds) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_FALSE(Checks().finite("a", bad).ok()) << bad;
    EXPECT_FALSE(Checks().within("a", bad, -1e300, 1e300).ok()) << bad;
  }
}

TEST(Checks, NameTheFieldTheValueAndTheLimit) {
  EXPECT_EQ(Checks().within("radius_m", 12.5, 0.0, 10.0).reason(), "radius_m = 12.5 is not within 0 and 10");
  EXPECT_EQ(Checks().count("points", 0, 1, 64).reason(), "points has 0 elements, not 1 to 64");
  Checks checks;
  checks.known("shape", static_cast<EditShape>(7), std::optional<int>());
  EXPECT_EQ(checks.reason(), "shape = 7 is no known value");
}

TEST(Checks, KeepTheFirstReason) {
  EXPECT_EQ(Checks().id("edit_id", "").within("radius_m", -1.0, 0.0, 1.0).reason(), "edit_id is empty");
}

TEST(Checks, RefuseIdsThatWouldGarbleALog) {
  EXPECT_FALSE(Checks().id("agv_id", "agv\n1").ok());
  EXPECT_FALSE(Checks().id("agv_id", "agv\x1b[31m").ok());
  EXPECT_TRUE(Checks().id("agv_id", "Stapler \xc3\xa4 1").ok());
}

TEST(Decoded, HoldsAValueOrAReason) {
  const Decoded<int> value = 7;
  ASSERT_TRUE(static_cast<bool>(value));
  EXPECT_EQ(*value, 7);
  const auto none = Decoded<int>::refused("too old");
  EXPECT_FALSE(static_cast<bool>(none));
  EXPECT_EQ(none.reason(), "too old");
}

}  // namespace
}  // namespace aisle::wire
