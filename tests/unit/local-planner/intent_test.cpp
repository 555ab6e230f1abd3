// The way that a vehicle says it will take.
#include "services/local-planner/core/intent.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

class IntentOf : public testing::Test {
 protected:
  IntentOf() {
    way.adopt(Lane(Route(resample({{2.0, 5.0}, {38.0, 5.0}}, 0.2))), {2.0, 5.0}, false);
    way.profile(clearance, 0.35, {1.0, 1.2, 0.6, 0.6, true});
  }
  grid::ClearanceField clearance{hall(40.0, 10.0)};
  Way way;
};

TEST_F(IntentOf, ReachesAsFarAsItMayAndTellsTheTimeToTheEnd) {
  const Intent intent = intent_of(way, 1e18);
  ASSERT_EQ(intent.points.size(), 7U);
  EXPECT_NEAR(intent.points.back().base_in_map.x, 26.0, 1e-6);
  EXPECT_NEAR(intent.points.front().offset_s, 24.0 / 7.0, 0.1);
  EXPECT_GT(intent.time_left_s, intent.points.back().offset_s + 10.0);
  EXPECT_LT(intent.time_left_s, 45.0);
}

TEST_F(IntentOf, EndsWhereItMustStop) {
  const Intent intent = intent_of(way, 3.0);
  ASSERT_FALSE(intent.points.empty());
  EXPECT_NEAR(intent.points.back().base_in_map.x, 5.0, 1e-6);
  EXPECT_TRUE(intent_of(way, 0.0).points.empty());
  for (std::size_t i = 1; i < intent.points.size(); ++i)
    EXPECT_GT(intent.points[i].offset_s, intent.points[i - 1].offset_s);
}

}  // namespace
}  // namespace aisle::local_planner
