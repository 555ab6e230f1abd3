// The plan in force becomes the lane, once; and whether the vehicle is still on it.
#include "services/local-planner/core/way_keeping.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class Keeping : public testing::Test {
 protected:
  Adoption adopt() {
    road.follow(stage.moment(), 0.0);
    return keeper.adopt(stage.moment(), road, way);
  }

  /// The plan with steps of 2 m, in a tube, granted so far.
  void grant(std::uint64_t limit_step) {
    stage.inputs.plan->tube_m = 0.1;
    stage.inputs.plan->step_ends_m = {2.0, 4.0, 6.0, 8.0, 10.0, 12.0};
    Grant grant;
    grant.number = limit_step;
    grant.limit_step = limit_step;
    stage.inputs.grant = grant;
  }

  Stage stage;
  Way way;
  Road road{LaneSettings{}, 0.6};
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

TEST_F(Keeping, InATubeTheLaneIsTheRoadAndFollowsWhatIsGranted) {
  stage.give_plan({{3.0, 5.0}, {7.0, 5.0}, {7.0, 9.0}, {3.0, 9.0}});
  grant(2);
  EXPECT_TRUE(adopt().has_new_lane);
  const auto off_turn_m = [&] {
    const Route& lane = way.lane();
    return geometry::distance(lane.at(lane.project({7.0, 5.0}, 0.0, 100.0)), {7.0, 5.0});
  };
  EXPECT_NEAR(off_turn_m(), 0.0, 1e-9);
  grant(3);
  EXPECT_FALSE(adopt().has_new_lane) << "the vehicle goes on where it is";
  EXPECT_GT(off_turn_m(), 0.1);
}

TEST_F(Keeping, AlonePlansThatTurnBackWhereTheVehicleIsBeginThere) {
  stage.give_plan({{1.0, 5.0}, {3.0, 5.0}, {1.0, 5.2}, {1.0, 9.0}});
  grant(3);
  stage.inputs.plan->tube_m = 0.0;
  stage.inputs.plan->step_ends_m = {2.0, 4.0, 7.8};  // the first is behind it
  adopt();
  EXPECT_NEAR(way.lane().length_m(), 5.8, 0.5);
  EXPECT_NEAR(way.lane().heading_at(0.1), 3.14, 0.4);
  EXPECT_NEAR(way.lane_m(road.way().length_m()), way.lane().length_m(), 1e-9) << "lengths are along the whole plan";
  EXPECT_LT(way.lane_m(4.0), 2.2);
}

TEST_F(Keeping, AnotherTubeIsANewLane) {
  grant(6);
  adopt();
  stage.inputs.plan->tube_m = 0.0;
  EXPECT_TRUE(adopt().has_new_lane);
}

TEST_F(Keeping, AnotherGoalEndsBackingOff) {
  adopt();
  way.back_off({{3.0, 5.0}, {3.0, 7.0}});
  stage.inputs.plan->id = 2;
  adopt();
  EXPECT_TRUE(way.backs_off()) << "the same goal";
  stage.inputs.plan->goal_id = "goal-2";
  EXPECT_TRUE(adopt().is_other_goal);
  EXPECT_FALSE(way.backs_off());
}

TEST_F(Keeping, APlannerThatKnowsNoPathDrivesStraightAtTheGoal) {
  stage.give_plan({{3.0, 5.0}, {9.0, 9.0}, {15.0, 5.0}});
  WayKeeper straight(Settings{}, false);
  straight.adopt(stage.moment(), road, way);
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
