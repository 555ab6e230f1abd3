#include "services/local-planner/core/dwa.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

struct World {
  explicit World(const grid::OccupancyGrid& grid) : clearance(grid) {}
  Scene scene(Pose2 base, Twist2 twist, double cap_mps = 1.2) const { return {clearance, base, twist, 0.35, {}, cap_mps, movers, peers}; }
  grid::ClearanceField clearance;
  std::vector<Mover> movers;
  std::vector<PeerMotion> peers;
};

Mover person(Point2 position, Point2 velocity) {
  Mover mover;
  mover.position_in_map = position;
  mover.velocity_in_map = velocity;
  return mover;
}

TEST(Obstruction, IsAWallThatTheVehicleCouldNotStopBefore) {
  const World world(hall(10.0, 10.0));
  const DwaSettings settings;      // 1.2 m/s: 0.12 m in a step and 0.67 m of braking, plus radius and margin: 1.2 m
  EXPECT_EQ(obstruction(world.scene({8.3, 5.0, 0.0}, {1.2, 0.0, 0.0}), {1.2, 0.0, 0.0}, settings), Obstruction::kNone);
  EXPECT_EQ(obstruction(world.scene({8.9, 5.0, 0.0}, {1.2, 0.0, 0.0}), {1.2, 0.0, 0.0}, settings), Obstruction::kWall);
}

TEST(Obstruction, IsLookedForAlongTheArc) {
  const World world(hall(10.0, 10.0));
  EXPECT_EQ(obstruction(world.scene({9.2, 5.0, 0.7}, {0.9, 1.0, 0.0}), {0.9, 1.0, 0.0}, {}), Obstruction::kNone);
  EXPECT_EQ(obstruction(world.scene({9.2, 5.0, 0.7}, {0.9, -1.0, 0.0}), {0.9, -1.0, 0.0}, {}), Obstruction::kWall);
}

TEST(Obstruction, AllowsTheWayOutOfAPlaceThatIsTooNear) {
  const World world(hall(10.0, 10.0));
  const Pose2 at_the_wall{9.62, 5.0, 0.0};      // 0.03 m of room, less than the margin
  EXPECT_EQ(obstruction(world.scene(at_the_wall, {}), {0.2, 0.0, 0.0}, {}), Obstruction::kWall);
  EXPECT_EQ(obstruction(world.scene({9.62, 5.0, geometry::kPi}, {}), {0.2, 0.0, 0.0}, {}), Obstruction::kNone);
  EXPECT_EQ(obstruction(world.scene(at_the_wall, {}), {0.0, 1.0, 0.0}, {}), Obstruction::kNone);
}

TEST(Obstruction, OfAPersonCountsOnlyWhileTheVehicleMoves) {
  World world(hall(20.0, 10.0));
  world.movers = {person({8.0, 5.0}, {-1.3, 0.0})};
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {0.2, 0.0, 0.0}), {0.2, 0.0, 0.0}, {}), Obstruction::kNone);   // stands before they are here
  EXPECT_EQ(obstruction(world.scene({5.8, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kMover);
}

TEST(Obstruction, OfAPersonIsWhereTheyWillBe) {
  World world(hall(20.0, 10.0));
  world.movers = {person({6.6, 5.8}, {0.0, 1.3})};     // beside the way, leaving
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kNone);
  world.movers = {person({5.8, 6.2}, {0.0, -1.3})};    // coming
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kMover);
}

TEST(Obstruction, NeverMovesWhileSomebodyWalksRightBesideUs) {
  World world(hall(20.0, 10.0));
  world.movers = {person({5.62, 5.0}, {-1.0, 0.0})};
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, geometry::kPi}, {}), {0.3, 0.0, 0.0}, {}), Obstruction::kMover);
}

TEST(Obstruction, IsTheBrakingDistanceOfAPeer) {
  World world(hall(20.0, 10.0));
  PeerMotion peer;
  peer.stopping_in_map = {{8.0, 5.0}};
  world.peers = {peer};
  EXPECT_EQ(obstruction(world.scene({6.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kNone);
  world.peers[0].stopping_in_map = {{8.0, 5.0}, {7.6, 5.0}, {7.2, 5.0}};   // it comes towards us
  EXPECT_EQ(obstruction(world.scene({6.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kPeer);
}

TEST(Choose, DrivesFastAndStraightWhenNothingIsInTheWay) {
  const World world(hall(20.0, 10.0));
  Aim aim;
  aim.target_in_map = {8.0, 5.0};
  const Choice choice = choose(world.scene({5.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), aim, wang(), {});
  ASSERT_TRUE(choice.found);
  EXPECT_DOUBLE_EQ(choice.twist.linear_mps, 1.2);
  EXPECT_NEAR(choice.twist.angular_radps, 0.0, 1e-9);
}

TEST(Choose, TurnsTowardsTheTarget) {
  const World world(hall(20.0, 10.0));
  Aim aim;
  aim.target_in_map = {6.0, 6.0};
  EXPECT_GT(choose(world.scene({5.0, 5.0, 0.0}, {0.4, 0.0, 0.0}, 0.5), aim, wang(), {}).twist.angular_radps, 0.2);
  aim.target_in_map = {6.0, 4.0};
  EXPECT_LT(choose(world.scene({5.0, 5.0, 0.0}, {0.4, 0.0, 0.0}, 0.5), aim, wang(), {}).twist.angular_radps, -0.2);
}

TEST(Choose, KeepsToTheSpeedCapAsFarAsBrakesAllow) {
  const World world(hall(20.0, 10.0));
  Aim aim;
  aim.target_in_map = {8.0, 5.0};
  EXPECT_LE(choose(world.scene({5.0, 5.0, 0.0}, {0.3, 0.0, 0.0}, 0.4), aim, wang(), {}).twist.linear_mps, 0.4 + 1e-9);
  EXPECT_LT(choose(world.scene({5.0, 5.0, 0.0}, {1.2, 0.0, 0.0}, 0.4), aim, wang(), {}).twist.linear_mps, 1.0);
}

/// The promise that everything rests on: whatever is chosen, braking along the arc afterwards touches nothing.
TEST(Choose, NeverTakesASpeedThatCannotBeStopped) {
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0.5, 11.5), angle(-3.1, 3.1), unit(0.0, 1.0);
  for (int i = 0; i < 12; ++i) {
    const double x = place(random), y = place(random);
    block(grid, x, y, x + 0.6, y + 0.6);
  }
  World world(grid);
  int chosen = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose2 base{place(random), place(random), angle(random)};
    if (world.clearance.clearance_m(base.position()) < 0.4) continue;
    world.movers = {person({place(random), place(random)}, {2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0})};
    const Scene scene = world.scene(base, {1.2 * unit(random), 2.4 * unit(random) - 1.2, 0.0});
    Aim aim;
    aim.target_in_map = {place(random), place(random)};
    const Choice choice = choose(scene, aim, wang(), {});
    if (!choice.found) continue;
    ++chosen;
    EXPECT_EQ(obstruction(scene, choice.twist, {}), Obstruction::kNone) << i;
  }
  EXPECT_GT(chosen, 100);
}

}  // namespace
}  // namespace aisle::local_planner
