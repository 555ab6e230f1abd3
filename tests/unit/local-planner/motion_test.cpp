// What is done to many samples at once is what is done to each.
#include "services/local-planner/core/motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "common/kinematics/vehicle_model.hpp"
#include "tests/unit/local-planner/some_twists.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

TEST(TwistBlock, FollowsAsEachVehicleDoes) {
  std::mt19937_64 random(1);
  const kinematics::Limits limits;
  for (int round = 0; round < 500; ++round) {
    const std::vector<Twist2> wanted = some_twists(random, 1 + random() % kBlock);
    const TwistBlock goals(wanted.data(), wanted.size());
    const Twist2 before = some_twist(random);
    TwistBlock twists(before);
    std::vector<kinematics::DriveState> alone(kBlock, {before, 0.0});
    for (int step = 0; step < 5; ++step) {
      follow_differential(twists, goals, limits, 0.1);
      bool differs = false;
      for (std::size_t i = 0; i < kBlock; ++i) {
        const Twist2& goal = wanted[std::min(i, wanted.size() - 1)];
        alone[i] = kinematics::follow(alone[i], goal, limits, 0.1);
        ASSERT_EQ(twists.at(i).linear_mps, alone[i].twist.linear_mps);
        ASSERT_EQ(twists.at(i).angular_radps, alone[i].twist.angular_radps);
        differs = differs || !is_same(alone[i].twist, goal);
      }
      ASSERT_EQ(differ(twists, goals), differs);
    }
  }
}

TEST(SteeringBlock, FollowsAsEachTricycleDoes) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> angle(-1.2, 1.2);
  for (int round = 0; round < 500; ++round) {
    kinematics::Limits limits;
    limits.model = kinematics::Model::kTricycle;
    limits.axle.is_rear = round % 2 == 0;
    std::vector<Twist2> wanted = some_twists(random, 1 + random() % kBlock);
    const kinematics::DriveState before{some_twist(random), angle(random)};
    if (round % 3 == 0) wanted[0] = before.twist;
    const TwistBlock goals(wanted.data(), wanted.size());
    TwistBlock twists(before.twist), all(before.twist);
    SteeringBlock steering(limits, before.steering_rad, goals), steering_all = steering;
    std::vector<kinematics::DriveState> alone(kBlock, before), alone_all = alone;
    for (int step = 0; step < 40; ++step) {
      steering.follow(twists, goals, limits, 0.1);
      steering_all.follow_all(all, goals, limits, 0.1);
      for (std::size_t i = 0; i < kBlock; ++i) {
        const Twist2& goal = wanted[std::min(i, wanted.size() - 1)];
        const Twist2& now = alone[i].twist;
        const bool is_there = now.linear_mps == goal.linear_mps && now.angular_radps == goal.angular_radps &&
                              now.sideways_mps == goal.sideways_mps;
        if (!is_there) alone[i] = kinematics::follow(alone[i], goal, limits, 0.1);
        alone_all[i] = kinematics::follow(alone_all[i], goal, limits, 0.1);
        ASSERT_EQ(twists.at(i).linear_mps, alone[i].twist.linear_mps) << "round " << round << " step " << step;
        ASSERT_EQ(twists.at(i).angular_radps, alone[i].twist.angular_radps) << "round " << round << " step " << step;
        ASSERT_EQ(all.at(i).linear_mps, alone_all[i].twist.linear_mps) << "round " << round << " step " << step;
        ASSERT_EQ(all.at(i).angular_radps, alone_all[i].twist.angular_radps) << "round " << round << " step " << step;
      }
    }
    EXPECT_FALSE(steering_all.is_turning());
  }
}

TEST(TwistBlock, SaysWhatTheFarthestPointDrives) {
  std::mt19937_64 random(2);
  for (const double sideways_mps : {0.0, 0.7}) {
    std::vector<Twist2> twists = some_twists(random, kBlock);
    for (std::size_t i = 0; i < kBlock; i += 3) twists[i].sideways_mps = sideways_mps;
    PerSample way_m;
    find_driven_m(TwistBlock(twists.data(), kBlock), 1.6, 0.1, way_m);
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double turn_mps = 1.6 * std::abs(twists[i].angular_radps);
      const double expected_mps = sideways_mps == 0.0
                                      ? std::hypot(twists[i].linear_mps, turn_mps)
                                      : std::hypot(twists[i].linear_mps, twists[i].sideways_mps) + turn_mps;
      EXPECT_NEAR(way_m[i], 0.1 * expected_mps, 1e-12);
    }
  }
}

TEST(ArcBlock, StepsAlongArcs) {
  std::mt19937_64 random(3);
  for (const double sideways_mps : {0.0, -0.4}) {
    std::vector<Twist2> twists = some_twists(random, kBlock);
    for (std::size_t i = 0; i < kBlock; i += 2) twists[i].sideways_mps = sideways_mps;
    const TwistBlock all(twists.data(), kBlock);
    const Pose2 start{3.0, -2.0, 0.7};
    ArcBlock arcs(start);
    arcs.set_steps(all, 0.1);
    ASSERT_EQ(arcs.sideways, sideways_mps != 0.0);
    std::vector<Pose2> alone(kBlock, start);
    for (int step = 0; step < 20; ++step) {
      arcs.step();
      for (std::size_t i = 0; i < kBlock; ++i) {
        alone[i] = kinematics::advance(alone[i], twists[i], 0.1);
        const Arc<geometry::Batch>& arc = arcs.batches[i / geometry::kBatch];
        const std::size_t k = i % geometry::kBatch;
        ASSERT_NEAR(geometry::distance({arc.x[k], arc.y[k]}, alone[i].position()), 0.0, 1e-4);
        const double yaw_rad = std::atan2(arc.sin_yaw()[k], arc.cos_yaw()[k]);
        ASSERT_NEAR(geometry::wrap(yaw_rad - alone[i].yaw), 0.0, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace aisle::local_planner
