// What the vehicle drives at.
#include "services/local-planner/core/target.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class TargetOf : public testing::Test {
 protected:
  geometry::Point2 in_sight(double speed_mps, bool knows_path = true) const {
    const Moment moment = stage.moment();
    const Way way = stage.straight_way();
    return target_in_sight({moment, way, stage.around, {speed_mps, 0.0, 0.0}}, knows_path);
  }

  Stage stage;
};

TEST_F(TargetOf, LiesTheFartherAheadTheFasterItDrives) {
  EXPECT_NEAR(in_sight(0.0).x, 3.7, 1e-9);
  EXPECT_NEAR(in_sight(1.0).x, 4.5, 1e-9);
  EXPECT_NEAR(in_sight(3.0).x, 4.8, 1e-9);
}

TEST_F(TargetOf, LiesNearerWhereTheStraightWayToItIsNotFree) {
  stage.around.add_standing({{4.6, 5.0}, 0.2}, {});
  EXPECT_LT(in_sight(1.0).x, 4.1);
  EXPECT_GT(in_sight(1.0).x, 3.15);
}

TEST_F(TargetOf, IsTheGoalForAPlannerThatKnowsNoPath) { EXPECT_NEAR(in_sight(1.0, false).x, 15.0, 1e-9); }

TEST_F(TargetOf, IsSeenFromWhereTheVehicleWillBe) {
  const Target target = target_at({4.0, 6.0}, stage.motion);
  EXPECT_NEAR(target.error_rad, geometry::kPi / 4.0, 1e-9);
  EXPECT_NEAR(target.distance_m, std::sqrt(2.0), 1e-9);
}

TEST_F(TargetOf, TheAimHasNoMoreRoomThanTheWayItself) {
  const auto cap_in = [](double aisle_m) {
    const Stage narrow({3.0, 5.0, 0.0}, aisle(aisle_m));
    const Moment moment = narrow.moment();
    const Way way = narrow.straight_way();
    return aim_at({4.0, 5.0}, {moment, way, narrow.around, {}}, wang(), DwaSettings{}).wall_cap_m;
  };
  EXPECT_NEAR(cap_in(3.0), 0.2, 1e-9);
  EXPECT_NEAR(cap_in(0.9), 0.1, 0.04);
}

TEST_F(TargetOf, TheAimHoldsTheWayAheadOnlyForCriticsThatAskForIt) {
  const Moment moment = stage.moment();
  const Way way = stage.straight_way();
  const OnWay on_way{moment, way, stage.around, {}};
  EXPECT_TRUE(aim_at({4.0, 5.0}, on_way, wang(), DwaSettings{}).path_in_map.empty());
  const Aim of_wu = aim_at({4.0, 5.0}, on_way, *find_variant("wu"), DwaSettings{});
  ASSERT_FALSE(of_wu.path_in_map.empty());
  EXPECT_NEAR(of_wu.path_in_map.front().x, 3.0, 1e-9);
  EXPECT_NEAR(of_wu.sub_target_in_map.x, 3.6, 1e-9);
}

TEST_F(TargetOf, AVehicleThatBacksOffKeepsToItsWayBack) {
  stage.around.movers = {Mover{}};
  stage.around.movers[0].position_in_map = {6.0, 5.0};
  stage.around.movers[0].velocity_in_map = {-1.0, 0.0};
  const Moment moment = stage.moment();
  Way way = stage.straight_way();
  const Scene scene{*stage.inputs.clearance,
                    stage.motion.base_then,
                    {1.0, 0.0, 0.0},
                    0.35,
                    moment.vehicle.limits,
                    1.0,
                    stage.around.movers,
                    stage.around.peer_motions,
                    0.0,
                    {0.0}};
  const OnWay on_way{moment, way, stage.around, {1.0, 0.0, 0.0}};
  EXPECT_TRUE(sub_target_beside(on_way, scene, {4.5, 5.0}));
  way.back_off({{3.0, 5.0}, {3.0, 8.0}});
  EXPECT_FALSE(sub_target_beside(on_way, scene, {4.5, 5.0}));
}

/// The plan goes on to the right by 0.14 m and turns back to the left there: the vehicle is half-way along that piece.
TEST_F(TargetOf, LiesAheadOnAPieceOfTheWayThatIsShorterThanTheLookAhead) {
  stage.give_plan({{3.0, 5.0}, {5.0, 5.0}, {5.0, 4.86}, {5.5, 6.0}});
  stage.place({5.0, 4.93, 0.0});
  const Moment moment = stage.moment();
  Way way;
  way.adopt_at(Lane(Route(stage.inputs.plan->waypoints_in_map)), stage.motion.base_now.position(), 2.07);
  ASSERT_NEAR(way.s_m(), 2.07, 1e-6);

  const Tube tube = tube_along(way.current(), way.s_m(), 2.14, 0.1);
  const geometry::Point2 target = target_in_sight({moment, way, stage.around, {}, &tube, 2.14}, true);
  EXPECT_NEAR(target.x, 5.0, 0.01);
  EXPECT_LT(target.y, 4.86) << "on down the piece that it is on, not back along the one before";
}

}  // namespace
}  // namespace aisle::local_planner
