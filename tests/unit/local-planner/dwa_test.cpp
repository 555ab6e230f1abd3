#include "services/local-planner/core/dwa.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

struct World {
  explicit World(const grid::OccupancyGrid& grid) : clearance(grid) {}
  Scene scene(Pose2 base, Twist2 twist, double cap_mps = 1.2) const {
    return {clearance, base, twist, 0.35, {}, cap_mps, movers, peers};
  }
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
  const DwaSettings settings;  // 1.2 m/s: 0.12 m in a step and 0.67 m of braking, plus radius and margin: 1.2 m
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
  const Pose2 at_the_wall{9.62, 5.0, 0.0};  // 0.03 m of room, less than the margin
  EXPECT_EQ(obstruction(world.scene(at_the_wall, {}), {0.2, 0.0, 0.0}, {}), Obstruction::kWall);
  EXPECT_EQ(obstruction(world.scene({9.62, 5.0, geometry::kPi}, {}), {0.2, 0.0, 0.0}, {}), Obstruction::kNone);
  EXPECT_EQ(obstruction(world.scene(at_the_wall, {}), {0.0, 1.0, 0.0}, {}), Obstruction::kNone);
}

TEST(Obstruction, OfAPersonCountsOnlyWhileTheVehicleMoves) {
  World world(hall(20.0, 10.0));
  world.movers = {person({8.0, 5.0}, {-1.3, 0.0})};
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {0.2, 0.0, 0.0}), {0.2, 0.0, 0.0}, {}),
            Obstruction::kNone);  // stands before they are here
  EXPECT_EQ(obstruction(world.scene({5.8, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kMover);
}

TEST(Obstruction, OfAPersonIsWhereTheyWillBe) {
  World world(hall(20.0, 10.0));
  world.movers = {person({6.6, 5.8}, {0.0, 1.3})};  // beside the way, leaving
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kNone);
  world.movers = {person({5.8, 6.2}, {0.0, -1.3})};  // coming
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kMover);
}

/// The velocity of a track overshoots where a person comes out from over the vehicle: they are farther off in the
/// prediction than on the floor.
TEST(NeededGaps, APersonIsBesideUntilTheyWereSeenElsewhere) {
  World world(hall(20.0, 10.0));
  const auto is_beside = [&](Point2 position, Point2 velocity, double unseen_s) {
    world.movers = {person(position, velocity)};
    world.movers[0].unseen_s = unseen_s;
    return needed_gaps(world.scene({5.0, 5.0, 0.0}, {}), {}).is_person_beside;
  };
  EXPECT_TRUE(is_beside({5.0, 5.65}, {0.0, 1.0}, 0.0));
  EXPECT_FALSE(is_beside({5.0, 5.75}, {0.0, 1.0}, 0.0));
  EXPECT_FALSE(is_beside({5.0, 5.65}, {}, 0.2)) << "a person who stands";
  EXPECT_TRUE(is_beside({5.0, 5.75}, {0.0, 1.4}, 0.2)) << "seen over the vehicle, at y = 5.47";
  EXPECT_FALSE(is_beside({5.0, 6.0}, {0.0, 1.4}, 0.2));
}

TEST(Obstruction, IsAPersonBesideTheWayWhoMayWalkAtAnyMoment) {
  World world(hall(20.0, 10.0));
  world.movers = {person({5.6, 6.0}, {})};  // 0.5 m from where the vehicle passes
  world.movers[0].unseen_s = 0.2;
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {0.6, 0.0, 0.0}), {0.6, 0.0, 0.0}, {}), Obstruction::kMover);
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {0.15, 0.0, 0.0}), {0.15, 0.0, 0.0}, {}), Obstruction::kNone);
  world.movers[0].may_walk = false;
  EXPECT_EQ(obstruction(world.scene({5.0, 5.0, 0.0}, {0.6, 0.0, 0.0}), {0.6, 0.0, 0.0}, {}), Obstruction::kNone);
}

/// Passive safety: whoever sets off towards the vehicle since they were last seen touches it at a stand, if at all.
TEST(Obstruction, LeavesNobodyToBeTouchedByAMovingVehicle) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> apart(0.62, 2.5), angle(-geometry::kPi, geometry::kPi), speed(0.1, 1.2),
      turn(-0.6, 0.6);
  const DwaSettings settings;
  World world(hall(20.0, 20.0));
  int passed = 0;
  for (int round = 0; round < 4000; ++round) {
    const double away_m = apart(random), at_rad = angle(random);
    const Twist2 twist{speed(random), turn(random), 0.0};
    const Point2 there{10.0 + away_m * std::cos(at_rad), 10.0 + away_m * std::sin(at_rad)};
    world.movers = {person(there, {})};
    world.movers[0].unseen_s = 0.2;
    if (obstruction(world.scene({10.0, 10.0, 0.0}, twist), twist, settings) != Obstruction::kNone) continue;
    ++passed;
    constexpr double kDt = 0.01, kSetOffMps = 1.3, kStartS = 0.45;
    Pose2 base{10.0, 10.0, 0.0};
    Twist2 now = twist;
    Point2 walker = there;
    double walked_s = 0.0;
    for (double t = -world.movers[0].unseen_s; std::abs(now.linear_mps) > 0.05; t += kDt) {
      walked_s += kDt;
      const Point2 way = base.position() - walker;
      walker = walker + (kDt * kSetOffMps * std::min(1.0, walked_s / kStartS) / geometry::norm(way)) * way;
      if (t < 0.0) continue;  // where the scene begins, the vehicle is there
      base = kinematics::advance(base, now, kDt);
      if (t > settings.step_s) now = kinematics::limit_change(now, {}, {}, settings.braking_share * kDt);
      ASSERT_GT(geometry::distance(base.position(), walker), 0.35 + world.movers[0].radius_m)
          << "round " << round << ", at " << now.linear_mps << " m/s";
    }
  }
  EXPECT_GT(passed, 500);
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
  world.peers[0].stopping_in_map = {{8.0, 5.0}, {7.6, 5.0}, {7.2, 5.0}};  // it comes towards us
  EXPECT_EQ(obstruction(world.scene({6.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), {1.0, 0.0, 0.0}, {}), Obstruction::kPeer);
}

/// A hall with people anywhere, as many as one cycle may meet.
World crowded(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0.5, 11.5), speed(-1.5, 1.5);
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  for (int i = 0; i < 6; ++i) {
    const double x = place(random), y = place(random);
    block(grid, x, y, x + 0.6, y + 0.6);
  }
  World world(grid);
  for (int i = 0; i < 20; ++i)
    world.movers.push_back(person({place(random), place(random)}, {speed(random), speed(random)}));
  PeerMotion peer;
  peer.stopping_in_map = {{place(random), place(random)}};
  world.peers = {peer};
  return world;
}

std::vector<Twist2> many_twists() {
  std::vector<Twist2> twists;
  for (int v = 0; v < 9; ++v)
    for (int w = -5; w <= 5; ++w) twists.push_back({0.1 * v, 0.15 * w, 0.0});
  return twists;
}

TEST(RollOut, GivesEachSampleWhatItGetsAlone) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const World world = crowded(seed);
    const Scene scene = world.scene({6.0, 6.0, 0.3 * static_cast<double>(seed)}, {0.5, 0.2, 0.0});
    const Needed needed = needed_gaps(scene, {});
    Aim aim;
    aim.path_in_map = {{6.0, 6.0}, {6.5, 6.2}, {7.0, 6.4}};
    const std::vector<Twist2> twists = many_twists();
    const std::vector<SampleBlock> together = batched::roll_out(scene, needed, twists, aim, {});
    const std::vector<Obstruction> stopping = batched::obstructions(scene, needed, twists, {});
    for (std::size_t i = 0; i < twists.size(); ++i) {
      const SampleBlock& block = together[i / kBlock];
      const SampleBlock block_of_one = batched::roll_out(scene, needed, {twists[i]}, aim, {}).front();
      const Sample<double> among = block.at(i % kBlock), alone = block_of_one.at(0);
      EXPECT_EQ(stopping[i], obstruction(scene, twists[i], {}));
      EXPECT_EQ(block.collisions[i % kBlock], block_of_one.collisions[0]);
      EXPECT_EQ(block.moves[i % kBlock], block_of_one.moves[0]);
      if (block_of_one.moves[0] && block_of_one.collisions[0] == Obstruction::kWall) continue;
      constexpr double kRoundingM = 1e-9;  // headings are turned forth and back while others still change theirs
      EXPECT_NEAR(among.wall_gap_m, alone.wall_gap_m, kRoundingM);
      EXPECT_NEAR(among.mover_gap_m, alone.mover_gap_m, kRoundingM);
      EXPECT_NEAR(among.moving_gap_m, alone.moving_gap_m, kRoundingM);
      EXPECT_NEAR(among.path_distance_m, alone.path_distance_m, kRoundingM);
      EXPECT_NEAR(among.end_x_m, alone.end_x_m, kRoundingM);
      EXPECT_NEAR(among.end_y_m, alone.end_y_m, kRoundingM);
    }
  }
}

double nearest_m(const std::vector<Point2>& path, Point2 p) {
  double nearest = 1e18;
  for (const Point2 q : path) nearest = std::min(nearest, geometry::distance(p, q));
  return nearest;
}

/// The same by one step after the other, of each person, with the models' own exact arcs.
TEST(RollOut, MeetsWhomAPlainLoopMeets) {
  const DwaSettings settings;
  Aim aim;
  aim.path_in_map = {{6.0, 6.0}, {6.5, 6.2}, {7.0, 6.4}, {7.2, 6.9}, {7.1, 7.4}};
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const World world = crowded(seed);
    const Scene scene = world.scene({6.0, 6.0, 0.3 * static_cast<double>(seed)}, {0.5, 0.2, 0.0});
    const std::vector<Twist2> twists = many_twists();
    const std::vector<SampleBlock> all = batched::roll_out(scene, needed_gaps(scene, settings), twists, aim, settings);
    for (std::size_t i = 0; i < twists.size(); ++i) {
      const Obstruction collision = all[i / kBlock].collisions[i % kBlock];
      const Sample<double> sample = all[i / kBlock].at(i % kBlock);
      if (collision == Obstruction::kWall) continue;
      Pose2 pose = scene.base_in_map;
      Twist2 twist = scene.twist;
      Pose2 looked_from;
      double moving_gap_m = aim.mover_cap_m, path_m = 0.0;
      for (int k = 1; k <= 20; ++k) {
        twist = kinematics::limit_change(twist, twists[i], scene.limits, 0.1);
        pose = kinematics::advance(pose, twist, 0.1);
        for (const Mover& mover : world.movers)
          moving_gap_m =
              std::min(moving_gap_m,
                       geometry::distance(pose.position(), mover.position_in_map + 0.1 * k * mover.velocity_in_map) -
                           0.35 - mover.radius_m);
        if (k % 4 == 0) path_m += 0.2 * nearest_m(aim.path_in_map, pose.position());
        if (k == 8) looked_from = pose;
      }
      EXPECT_NEAR(sample.moving_gap_m, moving_gap_m, 1e-3);
      EXPECT_NEAR(sample.path_distance_m, path_m, 1e-3);
      EXPECT_NEAR(geometry::distance({sample.look_x_m, sample.look_y_m}, looked_from.position()), 0.0, 1e-3);
      EXPECT_NEAR(geometry::wrap(sample.look_yaw_rad - looked_from.yaw), 0.0, 1e-6);
      EXPECT_NEAR(geometry::distance({sample.end_x_m, sample.end_y_m}, pose.position()), 0.0, 1e-3);
      EXPECT_EQ(collision != Obstruction::kNone, moving_gap_m < 0.0);
      if (moving_gap_m < aim.mover_cap_m) ++met;
    }
  }
  EXPECT_GT(met, 100);
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

/// A door of 1 m, 3 m ahead, for a vehicle that looks 3 s ahead and is turned by a trifle: each arc as long as that
/// would end on its jambs.
TEST(Choose, DrivesOnToADoorThatItsArcsWouldMiss) {
  grid::OccupancyGrid grid = hall(20.0, 10.0);
  block(grid, 8.0, 0.0, 9.0, 4.5);
  block(grid, 8.0, 5.5, 9.0, 10.0);
  const World world(grid);
  DwaSettings settings;
  settings.horizon_s = 3.0;
  Aim aim;
  aim.target_in_map = {6.5, 5.0};
  const Scene scene = world.scene({5.0, 5.03, -0.06}, {1.2, 0.0, 0.0});
  aim.wall_cap_m = 0.15;    // what there is in the door
  aim.walls_s = 1.5 / 1.2;  // to the target
  const Choice choice = choose(scene, aim, *find_variant("yu"), settings);
  ASSERT_TRUE(choice.found);
  EXPECT_GT(choice.twist.linear_mps, 1.0);
  EXPECT_NEAR(choice.twist.angular_radps, 0.0, 0.2);
  aim.walls_s = 1e9;
  const Choice deterred = choose(scene, aim, *find_variant("yu"), settings);
  EXPECT_GT(std::abs(deterred.twist.angular_radps), 0.3) << "nothing that this test could see";
}

TEST(Choose, TurnsTowardsTheTarget) {
  const World world(hall(20.0, 10.0));
  Aim aim;
  aim.target_in_map = {6.0, 6.0};
  EXPECT_GT(choose(world.scene({5.0, 5.0, 0.0}, {0.4, 0.0, 0.0}, 0.5), aim, wang(), {}).twist.angular_radps, 0.2);
  aim.target_in_map = {6.0, 4.0};
  EXPECT_LT(choose(world.scene({5.0, 5.0, 0.0}, {0.4, 0.0, 0.0}, 0.5), aim, wang(), {}).twist.angular_radps, -0.2);
}

/// The heading critic in another unit: a power of two, so that nothing is rounded otherwise.
const Critic heading_in_another_unit{
    [](const Sample<double>& sample, const Aim& aim) { return 1024.0 * heading_critic.score(sample, aim); },
    [](const SampleBlock& samples, const Aim& aim, PerSample& scores) {
      heading_critic.score_block(samples, aim, scores);
      for (std::size_t i = 0; i < kBlock; ++i) scores[i] *= 1024.0;
    }};

// The papers' smoothing sigma: the unit of a critic does not matter, its weight does.
TEST(Choose, WeighsCriticsWhateverTheirUnit) {
  World world(hall(12.0, 12.0));
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> place(2.0, 10.0), angle(-3.1, 3.1), unit(0.0, 1.0);
  Variant other_unit = wang(), other_weight = wang();
  other_unit.critics.front().critic = heading_in_another_unit;
  other_weight.critics.front().weight *= 1024.0;
  const auto speeds = [](const Choice& choice) {
    return std::pair(choice.twist.linear_mps, choice.twist.angular_radps);
  };
  int differ = 0;
  for (int i = 0; i < 100; ++i) {
    const Scene scene = world.scene({place(random), place(random), angle(random)}, {unit(random), 0.0, 0.0});
    Aim aim;
    aim.target_in_map = {place(random), place(random)};
    const auto chosen = speeds(choose(scene, aim, wang(), {}));
    EXPECT_EQ(speeds(choose(scene, aim, other_unit, {})), chosen) << i;
    differ += speeds(choose(scene, aim, other_weight, {})) == chosen ? 0 : 1;
  }
  EXPECT_GT(differ, 20);
}

TEST(Choose, KeepsToTheSpeedCapAsFarAsBrakesAllow) {
  const World world(hall(20.0, 10.0));
  Aim aim;
  aim.target_in_map = {8.0, 5.0};
  EXPECT_LE(choose(world.scene({5.0, 5.0, 0.0}, {0.3, 0.0, 0.0}, 0.4), aim, wang(), {}).twist.linear_mps, 0.4 + 1e-9);
  EXPECT_LT(choose(world.scene({5.0, 5.0, 0.0}, {1.2, 0.0, 0.0}, 0.4), aim, wang(), {}).twist.linear_mps, 1.0);
}

TEST(Choose, KeepsItsSpeedWhereAnotherIsWorthLittle) {
  const World world(hall(30.0, 10.0));
  Aim aim;
  aim.target_in_map = {20.0, 5.0};
  DwaSettings settings;
  for (const double mps : {1.185, 1.19, 1.195})
    EXPECT_DOUBLE_EQ(choose(world.scene({10.0, 5.0, 0.0}, {mps, 0.0, 0.0}), aim, wang(), settings).twist.linear_mps,
                     mps);
  EXPECT_GT(choose(world.scene({10.0, 5.0, 0.0}, {1.0, 0.0, 0.0}), aim, wang(), settings).twist.linear_mps, 1.1);
  settings.change_worth = 0.0;
  EXPECT_DOUBLE_EQ(choose(world.scene({10.0, 5.0, 0.0}, {1.19, 0.0, 0.0}), aim, wang(), settings).twist.linear_mps,
                   1.2);
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
