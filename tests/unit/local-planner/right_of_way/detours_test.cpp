// Ways around what stands on the lane.
#include "services/local-planner/core/right_of_way/detours.hpp"

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
  EXPECT_TRUE(detour->is_around_something);
  EXPECT_GT(detour->rejoin_m, 2.0);
  const Room room = stage.moment().room(stage.around, 0.0, 0.0);
  for (const geometry::Point2 p : detour->points_in_map) EXPECT_GE(room.spare_m(p), 0.0);
  EXPECT_FALSE(detours.blocked());
}

TEST_F(DetoursOn, LeadsBackToALaneThatWasLeft) {
  stage.place({4.0, 6.5, 0.0});
  const auto detour = look(0.0);
  ASSERT_TRUE(detour);
  EXPECT_FALSE(detour->is_around_something);
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

TEST_F(DetoursOn, AForkliftKeepsToItsPlan) {
  stage.inputs.vehicle = forklift();
  stage.around.add_standing({{6.0, 5.0}, 0.3}, {});
  EXPECT_FALSE(look(0.0));
  EXPECT_TRUE(detours.blocked());
}

}  // namespace
}  // namespace aisle::local_planner
