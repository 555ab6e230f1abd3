// The way that a vehicle claims.
#include "services/local-planner/core/right_of_way/claim.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

class ClaimedWay : public testing::Test {
 protected:
  ClaimedWay() {
    way.adopt(Route(resample({{2.0, 5.0}, {38.0, 5.0}}, 0.2)), {2.0, 5.0}, false);
    way.profile(clearance, 0.35, {1.0, 1.2, 0.6, 0.6, true});
  }
  grid::ClearanceField clearance{hall(40.0, 10.0)};
  Way way;
};

TEST_F(ClaimedWay, ReachAsFarAsTheyMayAndTellTheTimeToTheEnd) {
  const Claim claim = claim_of(way, 1e18);
  ASSERT_FALSE(claim.points.empty());
  EXPECT_LE(claim.points.size(), 62u);
  EXPECT_NEAR(claim.points.back().base_in_map.x, 26.0, 1e-6);
  EXPECT_GT(claim.time_left_s, claim.points.back().offset_s + 10.0);
  EXPECT_LT(claim.time_left_s, 45.0);
}

TEST_F(ClaimedWay, EndWhereItMustStop) {
  const Claim claim = claim_of(way, 3.0);
  ASSERT_FALSE(claim.points.empty());
  EXPECT_NEAR(claim.points.back().base_in_map.x, 5.0, 1e-6);
  EXPECT_TRUE(claim_of(way, 0.0).points.empty());
  for (std::size_t i = 1; i < claim.points.size(); ++i)
    EXPECT_GT(claim.points[i].offset_s, claim.points[i - 1].offset_s);
}

}  // namespace
}  // namespace aisle::local_planner
