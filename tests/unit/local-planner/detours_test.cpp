// Ways around what stands on the lane.
#include "services/local-planner/core/detours.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class DetoursOn : public testing::Test {
 protected:
  explicit DetoursOn(const grid::OccupancyGrid& grid = hall(20.0, 10.0))
      : stage({3.0, 5.0, 0.0}, grid), way(stage.straight_way()) {}

  std::optional<Detour> look(double later_s) { return detours.look(stage.moment(later_s), stage.around, way); }

  Stage stage;
  Way way;
  Detours detours{LaneSettings{}};
};

class DetoursInAnAisle : public DetoursOn {
 protected:
  DetoursInAnAisle() : DetoursOn(aisle(1.2)) {}
};

TEST_F(DetoursOn, NothingStandsNothingIsLookedFor) {
  EXPECT_FALSE(look(0.0));
  EXPECT_FALSE(detours.blocked());
}

TEST_F(DetoursOn, LeadsAroundWhatStandsAndBackToTheLane) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  const auto detour = look(0.0);
  ASSERT_TRUE(detour);
  EXPECT_EQ(detour->kind, Detour::Kind::kAroundThing);
  EXPECT_GT(detour->rejoin_m, 2.0);
  const Room room = stage.moment().room(stage.around, 0.0, 0.0);
  for (const geometry::Point2 p : detour->points_in_map) EXPECT_GE(room.spare_m(p), 0.0);
  EXPECT_FALSE(detours.blocked());
}

TEST_F(DetoursOn, LeadsBackToALaneThatWasLeft) {
  stage.place({4.0, 6.5, 0.0});
  const auto detour = look(0.0);
  ASSERT_TRUE(detour);
  EXPECT_EQ(detour->kind, Detour::Kind::kBackToLane);
}

TEST_F(DetoursOn, LooksFiveTimesASecondAndAtOnceWhenHastened) {
  look(0.0);
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  EXPECT_FALSE(look(0.1));
  detours.hasten();
  EXPECT_TRUE(look(0.12));
  EXPECT_FALSE(look(0.14));
  EXPECT_TRUE(look(0.34));
}

TEST_F(DetoursInAnAisle, WhatLeavesNoWayAroundBlocksUntilItIsGone) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, "agv-2");
  EXPECT_FALSE(look(0.0));
  ASSERT_TRUE(detours.blocked());
  EXPECT_EQ(detours.blocked()->vehicle_id, "agv-2");
  EXPECT_NEAR(detours.blocked()->where.at_in_map.x, 4.4, 0.2);
  stage.around = {};
  look(1.0);
  EXPECT_FALSE(detours.blocked());
}

TEST_F(DetoursInAnAisle, ANewLaneForgetsWhatBlockedTheOldOne) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  look(0.0);
  ASSERT_TRUE(detours.blocked());
  EXPECT_EQ(detours.blocked()->vehicle_id, "") << "no vehicle";
  detours.begin();
  EXPECT_FALSE(detours.blocked());
}

TEST_F(DetoursOn, MustBeBackBeforeTheEndOfWhatIsGranted) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  EXPECT_FALSE(detours.look(stage.moment(0.0), stage.around, way, 2.5));
  ASSERT_TRUE(detours.blocked());
  detours.begin();
  EXPECT_FALSE(detours.look(stage.moment(0.0), stage.around, way, 1.0));
  EXPECT_FALSE(detours.blocked()) << "it is beyond";
  detours.begin();
  EXPECT_TRUE(detours.look(stage.moment(0.0), stage.around, way, 6.0));
}

TEST_F(DetoursOn, InATubeAThingBlocksAndAVehicleDoesNot) {
  const double all_m = way.lane().length_m();
  stage.around.add_standing({{5.0, 5.2}, 0.3}, "agv-2");
  detours.look_in_tube(stage.moment(0.0), stage.around, way, all_m);
  EXPECT_FALSE(detours.blocked());
  stage.around.add_standing({{6.0, 5.2}, 0.3}, {});
  detours.look_in_tube(stage.moment(1.0), stage.around, way, all_m);
  ASSERT_TRUE(detours.blocked());
  ASSERT_TRUE(detours.blocked()->thing);
  EXPECT_EQ(detours.blocked()->thing->position, (geometry::Point2{6.0, 5.2}));
  stage.around = {};
  detours.look_in_tube(stage.moment(2.0), stage.around, way, all_m);
  EXPECT_FALSE(detours.blocked());
}

class DetoursPastWalkers : public DetoursOn {
 protected:
  void walk_ahead(geometry::Point2 velocity) {
    Mover mover;
    mover.position_in_map = {5.0, 5.0};
    mover.velocity_in_map = velocity;
    stage.around.movers = {mover};
  }
};

TEST_F(DetoursPastWalkers, PassASlowOneWhoWalksTheSameWay) {
  walk_ahead({0.4, 0.0});
  const auto detour = look(0.0);
  ASSERT_TRUE(detour);
  EXPECT_EQ(detour->kind, Detour::Kind::kPastWalker);
  EXPECT_GT(detour->rejoin_m, 2.0 + 3.0 * 0.4) << "beyond where they will be";
  EXPECT_FALSE(detours.blocked());
}

TEST_F(DetoursPastWalkers, LeaveThoseWhoAreFastOrWalkAnotherWay) {
  for (const geometry::Point2 velocity : {geometry::Point2{1.1, 0.0}, {0.0, 0.4}, {0.0, 0.0}}) {
    detours.begin();
    walk_ahead(velocity);
    EXPECT_FALSE(look(0.0)) << velocity.x << " " << velocity.y;
  }
}

TEST_F(DetoursPastWalkers, PassOneWhoComesTowardsItOnce) {
  walk_ahead({-1.1, 0.0});
  const auto detour = look(0.0);
  ASSERT_TRUE(detour);
  EXPECT_EQ(detour->kind, Detour::Kind::kPastWalker);

  way.detour(detour->points_in_map, detour->rejoin_m);
  EXPECT_FALSE(look(1.0)) << "it is on its way past them";
}

TEST_F(DetoursInAnAisle, NobodyIsPassedWhereThereIsNoRoom) {
  Mover mover;
  mover.position_in_map = {5.0, 5.0};
  mover.velocity_in_map = {0.4, 0.0};
  stage.around.movers = {mover};
  EXPECT_FALSE(look(0.0));
  EXPECT_FALSE(detours.blocked()) << "they walk on";
}

TEST_F(DetoursOn, AForkliftKeepsToItsPlan) {
  stage.inputs.vehicle = forklift();
  stage.around.add_standing({{6.0, 5.0}, 0.3}, {});
  EXPECT_FALSE(look(0.0));
  EXPECT_TRUE(detours.blocked());
}

}  // namespace
}  // namespace aisle::local_planner
