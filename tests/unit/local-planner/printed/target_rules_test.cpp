// What each paper's dynamic window aims at.
#include <gtest/gtest.h>

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/printed/target_rule.hpp"
#include "services/local-planner/core/rolling_window.hpp"
#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

/// A vehicle at a place in a hall, on a path with one turn, and a collinear node before and after it.
class TargetRules : public testing::Test {
 protected:
  PrintedTarget ask(TargetRule rule, Point2 at, std::size_t next_node = 1, double speed_mps = 0.0) {
    stage.place({at.x, at.y, 0.0});
    const Moment moment = stage.moment();
    const Scene scene{*stage.inputs.clearance,
                      stage.motion.base_then,
                      {speed_mps, 0.0, 0.0},
                      0.2,
                      moment.vehicle.limits,
                      1.2,
                      stage.around.movers,
                      stage.around.peer_motions,
                      0.0,
                      {0.0}};
    const Room room = moment.room(stage.around, 0.0, 0.0);
    return rule({path, path.project(at, 0.0, path.length_m()), next_node, scene, room, printed});
  }

  Stage stage;
  Route path{{{3.0, 2.0}, {6.0, 2.0}, {9.0, 2.0}, {9.0, 5.0}, {9.0, 8.0}}};
  AsPrinted printed;
};

TEST_F(TargetRules, OfTheTraditionalOneIsTheGoal) {
  EXPECT_EQ(ask(target_rules::goal, {3.0, 2.0}).target_in_map, (Point2{9.0, 8.0}));
}

TEST_F(TargetRules, OfQuAndYuAreThePathsNodesInTurn) {
  PrintedTarget target = ask(target_rules::path_nodes, {3.0, 2.0});
  EXPECT_EQ(target.target_in_map, (Point2{6.0, 2.0}));
  target = ask(target_rules::path_nodes, {4.9, 2.0}, target.next_node);
  EXPECT_EQ(target.target_in_map, (Point2{6.0, 2.0})) << "1.1 m before it";
  target = ask(target_rules::path_nodes, {5.1, 2.0}, target.next_node);
  EXPECT_EQ(target.target_in_map, (Point2{9.0, 2.0})) << "0.9 m before it";
  target = ask(target_rules::path_nodes, {6.0, 2.0}, target.next_node);
  EXPECT_EQ(target.target_in_map, (Point2{9.0, 2.0})) << "what was reached is not aimed at again";
  EXPECT_EQ(ask(target_rules::path_nodes, {9.0, 8.0}, 4).target_in_map, (Point2{9.0, 8.0})) << "the goal stays";
}

TEST_F(TargetRules, OfWangAreTheTurningPointsAlone) {
  PrintedTarget target = ask(target_rules::turning_points, {3.0, 2.0});
  EXPECT_EQ(target.target_in_map, (Point2{9.0, 2.0})) << "(6, 2) is no turn";
  target = ask(target_rules::turning_points, {8.5, 2.0}, target.next_node);
  EXPECT_EQ(target.target_in_map, (Point2{9.0, 8.0})) << "(9, 5) is none either: the goal";
}

TEST_F(TargetRules, NextTargetComesAtTheDistanceThatIsSet) {
  printed.next_target_m = 0.3;
  EXPECT_EQ(ask(target_rules::path_nodes, {5.6, 2.0}).target_in_map, (Point2{6.0, 2.0}));
  printed.next_target_m = 2.0;
  EXPECT_EQ(ask(target_rules::path_nodes, {4.1, 2.0}).target_in_map, (Point2{9.0, 2.0}));
}

TEST_F(TargetRules, OfLiAreTheGoalAndTheNearestPointOfThePath) {
  printed.next_target_m = 0.5;
  const PrintedTarget target = ask(target_rules::nearest_path_point, {4.2, 2.3});
  EXPECT_EQ(target.target_in_map, (Point2{9.0, 8.0})) << "heading, eq. 8";
  EXPECT_EQ(target.sub_target_in_map, (Point2{5.0, 2.0})) << "Yheading's G_i, eq. 10: a path point a metre";
  EXPECT_EQ(ask(target_rules::nearest_path_point, {4.8, 2.0}).sub_target_in_map, (Point2{6.0, 2.0}));
  EXPECT_EQ(ask(target_rules::nearest_path_point, {9.0, 7.9}).sub_target_in_map, (Point2{9.0, 8.0})) << "the path ends";
}

TEST_F(TargetRules, OfWuIsThePathWhileNoCollisionIsPredicted) {
  printed.path_ahead_m = 0.8;
  const PrintedTarget target = ask(target_rules::local_sub_target, {4.0, 2.0}, 1, 0.8);
  EXPECT_TRUE(target.follows_path);
  EXPECT_NEAR(target.target_in_map.x, 4.8, 1e-9);
}

TEST_F(TargetRules, OfWuIsTheLocalSubTargetBesideWhatWouldBeHit) {
  Mover box;
  box.position_in_map = {6.0, 2.0};
  box.margin_m = box.growth_mps = 0.0;
  stage.around.movers = {box};
  stage.around.add_standing({box.position_in_map, box.radius_m}, {});
  const PrintedTarget target = ask(target_rules::local_sub_target, {4.0, 2.0}, 1, 0.8);
  EXPECT_FALSE(target.follows_path);
  EXPECT_GT(std::abs(target.target_in_map.y - 2.0), 0.1) << "beside the path";
  EXPECT_GT(target.target_in_map.x, 4.0);
}

TEST_F(TargetRules, OfWuKeepsToThePathWhereTheCrosserIsThroughInTime) {
  Mover crosser;
  crosser.position_in_map = {6.0, 4.0};
  crosser.velocity_in_map = {0.0, -2.5};
  crosser.margin_m = crosser.growth_mps = 0.0;
  stage.around.movers = {crosser};
  EXPECT_TRUE(ask(target_rules::local_sub_target, {4.0, 2.0}, 1, 0.8).follows_path) << "WU figure 12";
  stage.around.movers[0].velocity_in_map = {0.0, -0.9};
  EXPECT_FALSE(ask(target_rules::local_sub_target, {4.0, 2.0}, 1, 0.8).follows_path) << "WU figure 14";
}

TEST_F(TargetRules, AreThoseOfThePapers) {
  EXPECT_EQ(find_variant("dwa")->printed.target_rule, target_rules::goal);
  EXPECT_EQ(find_variant("li")->printed.target_rule, target_rules::nearest_path_point);
  EXPECT_EQ(find_variant("qu")->printed.target_rule, target_rules::path_nodes);
  EXPECT_EQ(find_variant("yu")->printed.target_rule, target_rules::path_nodes);
  EXPECT_EQ(find_variant("wang")->printed.target_rule, target_rules::turning_points);
  EXPECT_EQ(find_variant("wu")->printed.target_rule, target_rules::local_sub_target);
}

}  // namespace
}  // namespace aisle::local_planner
