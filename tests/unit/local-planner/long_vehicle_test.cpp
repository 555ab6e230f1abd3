// Vehicles that are no disc, or cannot turn on the spot: what they must not sweep, and what they can drive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/kinematics/tricycle.hpp"
#include "services/local-planner/core/dwa.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

const geometry::Footprint kForklift = geometry::rectangle(2.4, 1.1, 0.4);

kinematics::Limits tricycle() {
  kinematics::Limits limits;
  limits.model = kinematics::Model::kTricycle;
  return limits;
}

struct World {
  explicit World(const grid::OccupancyGrid& grid) : clearance(grid) {}
  Scene scene(const geometry::Footprint& footprint, const kinematics::Limits& limits, Pose2 base, Twist2 twist,
              double steering_rad = 0.0) const {
    const geometry::CoveringDiscs discs = geometry::covering_discs(footprint);
    return {clearance, base, twist, discs.radius_m, limits, 1.2, movers, peers, steering_rad, discs.ahead_m};
  }
  grid::ClearanceField clearance;
  std::vector<Mover> movers;
  std::vector<PeerMotion> peers;
};

TEST(LongVehicle, TheNoseStopsBeforeTheWall) {
  const World world(hall(12.0, 10.0));  // the nose is 1.6 m before the base, and so is its last disc within 3 cm
  EXPECT_EQ(obstruction(world.scene(kForklift, tricycle(), {9.8, 5.0, 0.0}, {}), {0.2, 0.0, 0.0}, {}),
            Obstruction::kNone);
  EXPECT_EQ(obstruction(world.scene(kForklift, tricycle(), {10.25, 5.0, 0.0}, {}), {0.2, 0.0, 0.0}, {}),
            Obstruction::kWall);
}

TEST(LongVehicle, TurnsOnTheSpotOnlyWhereItsCornersHaveRoom) {
  const World world(aisle(1.6));
  const Twist2 turn{0.0, 0.8, 0.0};
  const geometry::Footprint box = geometry::rectangle(1.8, 0.8);
  EXPECT_EQ(obstruction(world.scene(box, {}, {10.0, 5.0, 0.5}, turn), turn, {}), Obstruction::kWall);
  EXPECT_EQ(obstruction(world.scene(geometry::disc(0.4), {}, {10.0, 5.0, 0.5}, turn), turn, {}), Obstruction::kNone);
  EXPECT_EQ(obstruction(World(aisle(4.0)).scene(box, {}, {10.0, 5.0, 0.5}, turn), turn, {}), Obstruction::kNone);
}

/// From rest it swings its nose to the left, for a step and while it brakes: as far as `swung_rad`.
TEST(LongVehicle, SwingsItsNoseIntoNothingThatStandsBesideIt) {
  World world(hall(12.0, 12.0));
  const kinematics::Limits limits;
  const DwaSettings settings;
  const Pose2 base{6.0, 6.0, 0.0};
  const geometry::CoveringDiscs discs = geometry::covering_discs(kForklift);
  const double nose_m = *std::max_element(discs.ahead_m.begin(), discs.ahead_m.end());
  const double swung_radps = limits.max_turn_acceleration_radps2 * settings.step_s,
               braking_mps2 = settings.braking_share * limits.max_deceleration_mps2;
  const double swung_rad =
      0.5 * swung_radps * settings.step_s + 0.5 * swung_radps * swung_radps * nose_m / braking_mps2;
  int refused = 0, allowed = 0;
  for (double gap_m = 0.005; gap_m < 0.3; gap_m += 0.005) {
    Mover thing;
    thing.may_walk = false;
    thing.growth_mps = 0.0;
    const double apart_m = discs.radius_m + thing.radius_m + thing.margin_m;
    thing.position_in_map = {base.x + nose_m, base.y + apart_m + gap_m};
    world.movers = {thing};
    const Obstruction found =
        obstruction(world.scene(kForklift, limits, base, {}), {0.0, limits.max_turn_radps, 0.0}, settings);
    const Point2 nose{base.x + nose_m * std::cos(swung_rad), base.y + nose_m * std::sin(swung_rad)};
    const bool comes_too_near = geometry::distance(nose, thing.position_in_map) < apart_m - 1e-3;
    EXPECT_TRUE(!comes_too_near || found == Obstruction::kMover) << gap_m;
    ++(found == Obstruction::kNone ? allowed : refused);
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(allowed, 10);
}

TEST(LongVehicle, MindsPeopleBesideItsNose) {
  World world(hall(12.0, 10.0));
  Mover person;
  person.position_in_map = {
      6.5, 5.75};  // before the base and to the left, where the disc around the base would be well clear
  person.velocity_in_map = {0.0, -0.3};
  world.movers = {person};
  const Twist2 ahead{0.6, 0.0, 0.0};
  EXPECT_EQ(obstruction(world.scene(kForklift, tricycle(), {5.0, 5.0, 0.0}, ahead), ahead, {}), Obstruction::kMover);
  EXPECT_EQ(obstruction(world.scene(geometry::disc(0.3), tricycle(), {5.0, 5.0, 0.0}, ahead), ahead, {}),
            Obstruction::kNone);
}

TEST(LongVehicle, APeerIsAsLongAsItIs) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  Peer peer;
  peer.id = "forklift";
  peer.radius_m = geometry::reach_m(kForklift);
  peer.rectangle = kForklift;
  peer.state = {{5.0, 5.0, geometry::kPi / 2}, {}};
  peer.state_arrived = std::chrono::seconds(100);
  inputs.peers = {peer};
  observer.observe(inputs, {5.0, 2.0}, std::chrono::seconds(96));
  const Surroundings around = observer.observe(inputs, {5.0, 2.0}, std::chrono::seconds(100));
  ASSERT_EQ(around.peer_motions.size(), 5U);
  ASSERT_EQ(around.standing.size(), 5U);
  double foremost = 0.0;
  for (const PeerMotion& motion : around.peer_motions)
    foremost = std::max(foremost, motion.stopping_in_map.front().y + motion.radius_m);
  EXPECT_GE(foremost, 5.0 + 1.6);
}

TEST(LongVehicle, TheWindowHoldsOnlyWhatTheWheelCanSteer) {
  const World world(hall(20.0, 20.0));
  const kinematics::Limits limits = tricycle();
  for (const double steering : {-0.9, 0.0, 0.5}) {
    const double v = 0.6;
    Scene scene = world.scene(kForklift, limits, {10.0, 10.0, 0.0},
                              {v, kinematics::turn_rate_radps(limits.axle, v, steering), 0.0}, steering);
    for (const double bearing : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
      Aim aim;
      aim.target_in_map = aim.sub_target_in_map = {10.0 + 3.0 * std::cos(bearing), 10.0 + 3.0 * std::sin(bearing)};
      const Choice choice = choose(scene, aim, wang(), {});
      ASSERT_TRUE(choice.found);
      const double chosen = kinematics::steering_for_rad(limits.axle, choice.twist, steering);
      EXPECT_LE(std::abs(chosen), limits.axle.max_steering_rad + 1e-9);
      EXPECT_LE(std::abs(chosen - steering), limits.axle.max_steering_rate_radps * DwaSettings{}.heading_s + 1e-9);
      EXPECT_LE(std::abs(choice.twist.angular_radps),
                std::abs(choice.twist.linear_mps) / kinematics::least_radius_m(limits.axle) + 1e-9);
    }
  }
}

TEST(Omnidirectional, TheWindowHasSidewaysSpeeds) {
  const World world(hall(20.0, 20.0));
  kinematics::Limits limits;
  limits.model = kinematics::Model::kOmnidirectional;
  Aim aim;
  aim.target_in_map = aim.sub_target_in_map = {10.0, 13.0};
  const auto to_target = [](const Sample<double>& sample, const Aim& to) {
    return 10.0 - geometry::distance({sample.end_x_m, sample.end_y_m}, to.target_in_map);
  };
  const auto block_to_target = [](const SampleBlock& samples, const Aim& to, PerSample& scores) {
    for (std::size_t i = 0; i < kBlock; ++i)
      scores[i] = 10.0 - geometry::distance({samples.at(i).end_x_m, samples.at(i).end_y_m}, to.target_in_map);
  };
  const Variant heading_only{"x", {{Critic{to_target, block_to_target}, 1.0}}};
  const Choice choice = choose(world.scene(geometry::disc(0.35), limits, {10.0, 10.0, 0.0}, {}), aim, heading_only, {});
  ASSERT_TRUE(choice.found);
  EXPECT_GT(choice.twist.sideways_mps, 0.1) << "the target is straight to its left";
}

}  // namespace
}  // namespace aisle::local_planner
