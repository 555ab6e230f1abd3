// What is done to many samples at once is what is done to each.
#include "services/local-planner/core/lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "services/local-planner/core/twist_lanes.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

Twist2 some_twist(std::mt19937_64& random) {
  std::uniform_real_distribution<double> speed(-0.5, 1.5), turn(-1.6, 1.6);
  const bool stands = random() % 8 == 0, is_straight = random() % 8 == 0;
  return {stands ? 0.0 : speed(random), is_straight ? 0.0 : turn(random), 0.0};
}

std::vector<Twist2> some_twists(std::mt19937_64& random, std::size_t count) {
  std::vector<Twist2> twists;
  for (std::size_t i = 0; i < count; ++i) twists.push_back(some_twist(random));
  return twists;
}

TEST(TwistLanes, FollowAsEachVehicleDoes) {
  std::mt19937_64 random(1);
  const kinematics::Limits limits;
  for (int round = 0; round < 500; ++round) {
    const std::vector<Twist2> wanted = some_twists(random, 1 + random() % kLanes);
    const TwistLanes goals(wanted.data(), wanted.size());
    const Twist2 before = some_twist(random);
    TwistLanes twists(before);
    std::vector<kinematics::DriveState> alone(kLanes, {before, 0.0});
    for (int step = 0; step < 5; ++step) {
      follow_differential(twists, goals, limits, 0.1);
      int differing = 0;
      for (std::size_t i = 0; i < kLanes; ++i) {
        const Twist2& goal = wanted[std::min(i, wanted.size() - 1)];
        alone[i] = kinematics::follow(alone[i], goal, limits, 0.1);
        ASSERT_EQ(twists.linear_mps[i], alone[i].twist.linear_mps);
        ASSERT_EQ(twists.angular_radps[i], alone[i].twist.angular_radps);
        if (alone[i].twist.linear_mps != goal.linear_mps || alone[i].twist.angular_radps != goal.angular_radps)
          ++differing;
      }
      ASSERT_EQ(count_differing(twists, goals), differing);
    }
  }
}

TEST(SteeringLanes, FollowAsEachTricycleDoes) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-1.2, 1.2);
  for (int round = 0; round < 500; ++round) {
    kinematics::Limits limits;
    limits.model = kinematics::Model::kTricycle;
    limits.axle.is_rear = round % 2 == 0;
    std::vector<Twist2> wanted = some_twists(random, 1 + random() % kLanes);
    const kinematics::DriveState before{some_twist(random), angle(random)};
    if (round % 3 == 0) wanted[0] = before.twist;
    const TwistLanes goals(wanted.data(), wanted.size());
    TwistLanes twists(before.twist), all(before.twist);
    SteeringLanes steering(limits, before.steering_rad, goals), steering_all = steering;
    std::vector<kinematics::DriveState> alone(kLanes, before), alone_all = alone;
    for (int step = 0; step < 40; ++step) {
      steering.follow(twists, goals, limits, 0.1);
      steering_all.follow_all(all, goals, limits, 0.1);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const Twist2& goal = wanted[std::min(i, wanted.size() - 1)];
        const Twist2& now = alone[i].twist;
        const bool is_there = now.linear_mps == goal.linear_mps && now.angular_radps == goal.angular_radps &&
                              now.sideways_mps == goal.sideways_mps;
        if (!is_there) alone[i] = kinematics::follow(alone[i], goal, limits, 0.1);
        alone_all[i] = kinematics::follow(alone_all[i], goal, limits, 0.1);
        ASSERT_EQ(twists.linear_mps[i], alone[i].twist.linear_mps) << "round " << round << " step " << step;
        ASSERT_EQ(twists.angular_radps[i], alone[i].twist.angular_radps) << "round " << round << " step " << step;
        ASSERT_EQ(all.linear_mps[i], alone_all[i].twist.linear_mps) << "round " << round << " step " << step;
        ASSERT_EQ(all.angular_radps[i], alone_all[i].twist.angular_radps) << "round " << round << " step " << step;
      }
    }
    EXPECT_FALSE(steering_all.is_turning());
  }
}

TEST(TwistLanes, SayWhatTheFarthestPointDrives) {
  std::mt19937_64 random(2);
  for (const double sideways_mps : {0.0, 0.7}) {
    std::vector<Twist2> twists = some_twists(random, kLanes);
    for (std::size_t i = 0; i < kLanes; i += 3) twists[i].sideways_mps = sideways_mps;
    Lane way_m;
    driven_m(TwistLanes(twists.data(), kLanes), 1.6, 0.1, way_m);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double turn_mps = 1.6 * std::abs(twists[i].angular_radps);
      const double expected_mps = sideways_mps == 0.0
                                      ? std::hypot(twists[i].linear_mps, turn_mps)
                                      : std::hypot(twists[i].linear_mps, twists[i].sideways_mps) + turn_mps;
      EXPECT_NEAR(way_m[i], 0.1 * expected_mps, 1e-12);
    }
  }
}

TEST(Lanes, StepAlongArcs) {
  std::mt19937_64 random(3);
  for (const double sideways_mps : {0.0, -0.4}) {
    std::vector<Twist2> twists = some_twists(random, kLanes);
    for (std::size_t i = 0; i < kLanes; i += 2) twists[i].sideways_mps = sideways_mps;
    const TwistLanes all(twists.data(), kLanes);
    const Pose2 start{3.0, -2.0, 0.7};
    Lanes lanes(start);
    lanes.set_steps(all.linear_mps, all.angular_radps, all.sideways_mps, 0.1);
    std::vector<Pose2> alone(kLanes, start);
    for (int step = 0; step < 20; ++step) {
      lanes.step();
      Lane yaw_rad;
      lanes.find_yaws_rad(yaw_rad);
      for (std::size_t i = 0; i < kLanes; ++i) {
        alone[i] = kinematics::advance(alone[i], twists[i], 0.1);
        ASSERT_NEAR(geometry::distance({lanes.x[i], lanes.y[i]}, alone[i].position()), 0.0, 1e-4);
        ASSERT_NEAR(geometry::wrap(yaw_rad[i] - alone[i].yaw), 0.0, 1e-6);
      }
    }
  }
}

/// The gap of one lane's vehicle, when every disc is looked up.
double gap_m(const Scene& scene, const Lanes& lanes, std::size_t i) {
  double least_m = 1e9;
  geometry::Wide cos_yaw, sin_yaw;
  const std::size_t first = i - i % geometry::kWide, k = i % geometry::kWide;
  lanes.find_headings(first, cos_yaw, sin_yaw);
  for (const double ahead_m : scene.discs_ahead_m)
    least_m = std::min(least_m, scene.clearance.clearance_m(
                                    Point2{lanes.x[i] + ahead_m * cos_yaw[k], lanes.y[i] + ahead_m * sin_yaw[k]}) -
                                    scene.radius_m);
  return least_m;
}

/// A rectangle's discs and a disc, far from walls and beside them: each least gap is that of its own nearest disc, or
/// known to be enough.
TEST(WallWatch, KnowsTheLeastGapOfEachSample) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> at(1.0, 11.0);
  grid::OccupancyGrid grid = hall(12.0, 12.0);
  for (int i = 0; i < 10; ++i) {
    const double x = at(random), y = at(random);
    block(grid, x, y, x + 0.5, y + 0.5);
  }
  const grid::ClearanceField clearance(grid);
  const std::vector<Mover> movers;
  const std::vector<PeerMotion> peers;
  constexpr double kEnoughM = 0.2;
  int near = 0, equal = 0;
  for (int round = 0; round < 300; ++round) {
    const geometry::CoveringDiscs discs =
        geometry::covering_discs(round % 2 == 0 ? geometry::disc(0.35) : geometry::rectangle(2.4, 1.1, 0.4));
    const Scene scene{
        clearance,    {at(random), at(random), 0.01 * round}, {}, discs.radius_m, {}, 1.2, movers, peers, 0.0,
        discs.ahead_m};
    const std::vector<Twist2> twists = some_twists(random, round % 3 == 0 ? 3 : kLanes);
    const TwistLanes all(twists.data(), twists.size());
    Lanes lanes(scene.base_in_map);
    lanes.set_steps(all.linear_mps, all.angular_radps, all.sideways_mps, 0.1);
    Lane way_m, expected_m;
    driven_m(all, swing_m(scene), 0.1, way_m);
    expected_m.fill(kEnoughM);
    Outlines outlines(scene);
    WallWatch walls(outlines, wall_gaps_m(scene), kEnoughM);
    std::size_t left = kLanes;  // nobody asks for this one any more
    for (int step = 0; step < 20; ++step) {
      lanes.step();
      outlines.follow(lanes);
      const bool is_near = walls.look(outlines, way_m);
      bool is_expected = false;
      for (std::size_t i = 0; i < kLanes; ++i) {
        if (i == left) continue;
        const double now_m = gap_m(scene, lanes, i);
        is_expected = is_expected || now_m < kEnoughM;
        expected_m[i] = std::min(expected_m[i], now_m);
        constexpr double kInterpolationM = 0.23 * 0.05;  // what it knew a moment ago is a lower bound as well
        ASSERT_NEAR(walls.least_gaps_m()[i], expected_m[i], kInterpolationM) << "round " << round;
        ASSERT_GE(walls.least_gaps_m()[i], expected_m[i]) << "round " << round;
        if (expected_m[i] == kEnoughM) continue;
        ++near;
        equal += walls.least_gaps_m()[i] == expected_m[i] ? 1 : 0;
      }
      ASSERT_TRUE(is_expected || !is_near) << "round " << round;
      if (step == 10) walls.leave(left = static_cast<std::size_t>(round) % kLanes);
    }
  }
  EXPECT_GT(near, 10000);
  EXPECT_GT(equal, near - near / 1000);
}

}  // namespace
}  // namespace aisle::local_planner
