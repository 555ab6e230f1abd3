#include "services/local-planner/core/way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

/// Down an aisle and back, 0.9 m beside: the nearest point of the beginning is not where the vehicle is.
Route there_and_back() { return Route(resample({{0.0, 0.0}, {20.0, 0.0}, {20.0, 0.9}, {0.0, 0.9}}, 0.2)); }

void drive_to(double s_m, Way& way) {
  way.adopt(Lane(there_and_back()), {0.0, 0.0}, false);
  for (double s = 0.0; s <= s_m; s += 0.1) way.progress(there_and_back().at(s));
}

TEST(Way, GoesOnAlongAPlanThatWasKept) {
  Way way;
  drive_to(38.0, way);
  ASSERT_NEAR(way.lane_s_m(), 38.0, 0.2);
  way.adopt(Lane(there_and_back()), there_and_back().at(38.0), true);  // made anew after a map edit
  EXPECT_NEAR(way.lane_s_m(), 38.0, 0.2);
}

TEST(Way, BeginsAPlanThatIsNewWhereTheVehicleIs) {
  Way way;
  drive_to(38.0, way);
  way.adopt(Lane(there_and_back()), there_and_back().at(38.0), false);
  EXPECT_LT(way.lane_s_m(), 5.0);
}

TEST(Way, FindsItsPlaceFarAlongAPlanThatIsNew) {
  Way way;
  way.adopt(Lane(Route({{0.0, 0.0}, {30.0, 0.0}})), {20.0, 0.5},
            false);  // a planner that was restarted gives the plan of before
  EXPECT_NEAR(way.lane_s_m(), 20.0, 1e-9);
}

TEST(Way, IsNotLookedForBeyondATurnThatIsStillDrivenTo) {
  Way way;
  way.adopt(Lane(Route({{0.0, 0.0}, {5.0, 0.0}, {0.0, 0.3}})), {0.0, 0.0}, false);
  for (double x = 0.0; x <= 4.8; x += 0.1) way.progress({x, 0.0});
  ASSERT_GT(way.s_near_m({4.8, 0.03}), 5.0) << "nearer to the way back";
  EXPECT_NEAR(way.s_near_m({4.8, 0.03}, 5.0), 4.8, 0.05);
}

TEST(Way, CountsADetourAsTheWayUntilItRejoins) {
  Way way;
  way.adopt(Lane(Route(resample({{0.0, 0.0}, {20.0, 0.0}}, 0.2))), {0.0, 0.0}, false);
  way.progress({1.0, 0.0});
  way.detour({{1.0, 0.0}, {3.0, 1.0}, {5.0, 0.0}}, 5.0);
  EXPECT_TRUE(way.is_on_detour());
  EXPECT_NEAR(way.left_m(), 2.0 * std::hypot(2.0, 1.0) + 15.0, 0.1);
  for (double x = 1.0; x <= 6.0; x += 0.2)
    way.progress({x, x < 3.0 ? 0.5 * (x - 1.0) : std::max(0.0, 0.5 * (5.0 - x))});
  EXPECT_FALSE(way.is_on_detour());
}

TEST(Way, ComesBackToWhereItWasAfterBackingOff) {
  Way way;
  drive_to(10.0, way);
  way.back_off({{10.0, 0.0}, {10.0, -1.0}});
  EXPECT_TRUE(way.backs_off());
  way.progress({10.0, -1.0});
  EXPECT_NEAR(way.left_m(), 0.0, 1e-9);
  way.come_back();
  EXPECT_NEAR(way.lane_s_m(), 10.0, 0.2);
}

TEST(Way, IsRoundedAnewWhereTheVehicleIs) {
  Way way;
  drive_to(38.0, way);
  way.adopt_at(Lane(there_and_back()), there_and_back().at(38.0), 38.0);
  EXPECT_NEAR(way.lane_s_m(), 38.0, 1e-6);
}

TEST(Way, KnowsWhereThePlansPointsLieOnItBehindADetourToo) {
  Way way;
  way.adopt(Lane(Route(resample({{0.0, 0.0}, {20.0, 0.0}}, 0.2))), {0.0, 0.0}, false);
  EXPECT_NEAR(way.lane_m(12.0), 12.0, 1e-9);
  way.detour({{1.0, 0.0}, {3.0, 1.0}, {5.0, 0.0}}, 5.0);
  EXPECT_NEAR(way.lane().at(way.lane_m(12.0)).x, 12.0, 1e-9);
}

TEST(Way, IsNotLookedForBeforeWhatIsDone) {
  Way way;
  way.adopt_at(Lane(Route({{0.0, 0.0}, {2.0, 0.0}, {0.0, 0.1}})), {2.0, 0.0}, 2.0);
  way.progress_at({1.85, 0.0}, 2.0, 2.0);
  EXPECT_NEAR(way.lane_s_m(), 1.85, 1e-9);
  way.progress_at({1.85, 0.0}, 2.0, 2.0, 2.0);
  EXPECT_NEAR(way.lane_s_m(), 2.0, 1e-9) << "it turns back there";
}

TEST(Way, IsLookedForWhereTheRoadKnowsItToBe) {
  Way way;
  way.adopt(Lane(Route({{0.0, 0.0}, {5.0, 0.0}, {0.0, 0.001}})), {0.0, 0.0}, false);  // out and back
  way.progress_at({4.5, 0.0}, 4.4, 5.0);
  EXPECT_NEAR(way.lane_s_m(), 4.5, 1e-3);
  way.progress_at({4.5, 0.0}, 5.5, 100.0);
  EXPECT_NEAR(way.lane_s_m(), 5.5, 1e-3);
  way.progress_at({4.5, 0.0}, 4.4, 4.3);
  EXPECT_NEAR(way.lane_s_m(), 4.3, 1e-9);
}

}  // namespace
}  // namespace aisle::local_planner
