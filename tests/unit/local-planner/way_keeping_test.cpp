// The plan in force becomes the lane, once; and whether the vehicle is still on it.
#include "services/local-planner/core/way_keeping.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class Keeping : public testing::Test {
 protected:
  Adoption adopt() { return keeper.adopt(stage.moment(), way); }

  Stage stage;
  Way way;
  WayKeeper keeper{Settings{}, true};
};

TEST_F(Keeping, TheFirstPlanIsANewLaneToAnotherGoal) {
  const Adoption adoption = adopt();
  EXPECT_TRUE(adoption.is_other_goal);
  EXPECT_TRUE(adoption.has_new_lane);
  EXPECT_NEAR(way.lane().points().back().x, 15.0, 1e-9);
  EXPECT_FALSE(adopt().has_new_lane) << "once";
}

TEST_F(Keeping, AnotherIdOrMapMakesTheLaneAnewAndIsNoOtherGoal) {
  adopt();
  stage.inputs.plan->id = 7;
  EXPECT_TRUE(adopt().has_new_lane);
  stage.inputs.map_revision = 2;
  const Adoption adoption = adopt();
  EXPECT_TRUE(adoption.has_new_lane);
  EXPECT_FALSE(adoption.is_other_goal);
}

TEST_F(Keeping, OtherTurningPointsUnderAnOldIdAreAnotherPlan) {
  adopt();
  stage.inputs.plan->waypoints_in_map = {{3.0, 5.0}, {9.0, 8.0}, {15.0, 5.0}};
  EXPECT_TRUE(adopt().has_new_lane);
  EXPECT_GT(way.lane().length_m(), 12.5);
}

TEST_F(Keeping, AnotherGoalEndsAWayAside) {
  adopt();
  way.step_aside({{3.0, 5.0}, {3.0, 7.0}});
  stage.inputs.plan->id = 2;
  adopt();
  EXPECT_TRUE(way.is_aside()) << "the same goal: others still want to pass";
  stage.inputs.plan->goal_id = "goal-2";
  EXPECT_TRUE(adopt().is_other_goal);
  EXPECT_FALSE(way.is_aside());
}

TEST_F(Keeping, APlannerThatKnowsNoPathDrivesStraightAtTheGoal) {
  stage.give_plan({{3.0, 5.0}, {9.0, 9.0}, {15.0, 5.0}});
  WayKeeper straight(Settings{}, false);
  straight.adopt(stage.moment(), way);
  EXPECT_NEAR(way.lane().length_m(), 12.0, 1e-9);
}

TEST_F(Keeping, AVehicleThatTurnsOnTheSpotIsNeverOffItsPath) {
  adopt();
  stage.place({6.0, 9.0, 3.0});
  EXPECT_FALSE(is_off_path(stage.moment(), way));
}

TEST_F(Keeping, AForkliftIsOffItsPathFarBesideItTurnedAwayOrBeyondItsEnd) {
  stage.inputs.vehicle = forklift();
  const auto is_off_at = [&](const geometry::Pose2& base) {
    stage.place(base);
    Way there = stage.straight_way();
    return is_off_path(stage.moment(), there);
  };
  EXPECT_FALSE(is_off_at({6.0, 5.4, 0.3}));
  EXPECT_TRUE(is_off_at({6.0, 5.7, 0.0}));
  EXPECT_TRUE(is_off_at({6.0, 5.0, 1.3}));
  EXPECT_FALSE(is_off_at({14.98, 5.0, 0.0}));
  EXPECT_TRUE(is_off_at({15.1, 5.0, 0.0}));
}

}  // namespace
}  // namespace aisle::local_planner
