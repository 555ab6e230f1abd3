#include "services/fake-vehicle/core/simulated_vehicle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace aisle::fake_vehicle {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// 40 x 10 m without walls but the border of the map.
class Vehicle : public ::testing::Test {
 protected:
  /// Advances in ticks of 20 ms and sends `twist` at each of them until `end`.
  void drive(SimulatedVehicle& vehicle, const geometry::Twist2& twist, time::Stamp end, bool send = true) {
    for (; now_ < end; now_ += milliseconds(20)) {
      if (send) vehicle.command(twist, now_);
      vehicle.advance_to(now_, {walls_, bodies_});
      fastest_mps_ = std::max(fastest_mps_, std::abs(vehicle.twist().linear_mps));
    }
  }
  grid::OccupancyGrid walls_{grid::Geometry{800, 200, 0.05, {0.0, 0.0}}};
  std::vector<geometry::Body> bodies_;
  Parameters parameters_;
  time::Stamp now_{seconds(100)};
  double fastest_mps_{0.0};
};

TEST_F(Vehicle, StandsUntilCommanded) {
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {}, seconds(101), false);
  EXPECT_EQ(vehicle.hold(), Hold::kNoCommand);
  EXPECT_DOUBLE_EQ(vehicle.base_in_map().x, 2.0);
}

TEST_F(Vehicle, KnowsOfACommandAfterTheDeadTime) {
  parameters_.dead_time_s = 0.1;
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {1.0, 0, 0}, now_ + milliseconds(100));
  EXPECT_DOUBLE_EQ(vehicle.twist().linear_mps, 0.0);
  drive(vehicle, {1.0, 0, 0}, now_ + milliseconds(60));
  EXPECT_GT(vehicle.twist().linear_mps, 0.0);
}

TEST_F(Vehicle, KeepsItsLimits) {
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {50.0, 0, 0}, seconds(104));
  EXPECT_DOUBLE_EQ(vehicle.twist().linear_mps, parameters_.limits.max_speed_mps);
  EXPECT_LE(fastest_mps_, parameters_.limits.max_speed_mps);
  // Four seconds at 0.8 m/s^2 up to 1.2 m/s, less the dead time and lag: about 3.8 m.
  EXPECT_NEAR(vehicle.base_in_map().x, 2.0 + 1.2 * (3.9 - 0.75 - 0.05), 0.15);
}

TEST_F(Vehicle, LagsBehindSmallChanges) {
  parameters_.dead_time_s = 0.0;
  parameters_.lag_s = 0.5;
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {0.1, 0, 0}, now_ + milliseconds(500));
  EXPECT_NEAR(vehicle.twist().linear_mps, 0.1 * (1.0 - std::exp(-1.0)), 0.005);
}

TEST_F(Vehicle, DrivesTheArcItIsTold) {
  parameters_.dead_time_s = 0.0;
  SimulatedVehicle vehicle(parameters_, {5, 5, 0});
  drive(vehicle, {0.5, 0.5, 0}, seconds(103));
  const geometry::Point2 center{5.0, 6.0};  // radius v / w = 1 m; the start-up bends it only a little
  EXPECT_NEAR(geometry::distance(vehicle.base_in_map().position(), center), 1.0, 0.2);
  EXPECT_GT(vehicle.base_in_map().yaw, 1.0);
}

TEST_F(Vehicle, SilenceStopsItWithinTheSafeDistance) {
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {1.2, 0, 0}, seconds(104));
  const double v = vehicle.twist().linear_mps;
  const double from = vehicle.base_in_map().x;
  drive(vehicle, {}, now_ + milliseconds(180), false);
  EXPECT_EQ(vehicle.hold(), Hold::kNone);
  drive(vehicle, {}, now_ + milliseconds(60), false);
  EXPECT_EQ(vehicle.hold(), Hold::kLateCommand);
  drive(vehicle, {}, now_ + seconds(3), false);
  EXPECT_DOUBLE_EQ(vehicle.twist().linear_mps, 0.0);
  const double a = parameters_.limits.max_deceleration_mps2;
  EXPECT_LE(vehicle.base_in_map().x - from, (v * 0.25 + v * v / (2 * a)) * 1.05);
}

TEST_F(Vehicle, DrivesAgainWhenCommandsComeBack) {
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(1));
  drive(vehicle, {}, now_ + seconds(3), false);
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(1));
  EXPECT_EQ(vehicle.hold(), Hold::kNone);
  EXPECT_GT(vehicle.twist().linear_mps, 0.5);
}

TEST_F(Vehicle, BrakesAndStandsWhileAPersonHoldsItAndGoesOnAsToldThen) {
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(3));
  const double from_m = vehicle.base_in_map().x;
  vehicle.hinder({true, 1.0});
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(3));
  EXPECT_EQ(vehicle.hold(), Hold::kPerson);
  EXPECT_EQ(vehicle.twist().linear_mps, 0.0);
  const double a = parameters_.limits.max_deceleration_mps2;
  EXPECT_LE(vehicle.base_in_map().x - from_m, 1.05 / (2 * a));

  vehicle.hinder({});
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(3));
  EXPECT_EQ(vehicle.hold(), Hold::kNone);
  EXPECT_DOUBLE_EQ(vehicle.twist().linear_mps, 1.0);
}

TEST_F(Vehicle, ASlowOneReachesItsShareOfTheTopSpeedEitherWay) {
  SimulatedVehicle vehicle(parameters_, {15, 5, 0});
  vehicle.hinder({false, 0.8});
  drive(vehicle, {50.0, 0, 0}, now_ + seconds(4));
  EXPECT_DOUBLE_EQ(vehicle.twist().linear_mps, 0.8 * parameters_.limits.max_speed_mps);
  drive(vehicle, {-50.0, 0, 0}, now_ + seconds(8));
  EXPECT_DOUBLE_EQ(vehicle.twist().linear_mps, -0.8 * parameters_.limits.max_reverse_mps);
}

TEST_F(Vehicle, StopsAtAWallAndCanBackOff) {
  for (int y = 0; y < 200; ++y) walls_.set({200, y}, grid::Occupancy::kOccupied);  // x from 10.0
  SimulatedVehicle vehicle(parameters_, {8, 5, 0});
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(5));
  EXPECT_EQ(vehicle.hold(), Hold::kContact);
  EXPECT_EQ(vehicle.contacts(), 1u);
  EXPECT_NEAR(vehicle.base_in_map().x, 10.0 - parameters_.radius_m, 0.01);
  EXPECT_LE(vehicle.base_in_map().x, 10.0 - parameters_.radius_m + 1e-9);
  drive(vehicle, {-0.2, 0, 0}, now_ + seconds(2));
  EXPECT_EQ(vehicle.hold(), Hold::kNone);
  EXPECT_LT(vehicle.base_in_map().x, 9.5);
}

TEST_F(Vehicle, StopsAtAnotherBody) {
  geometry::Body other;
  other.base_in_map = {6.0, 5.0, 0.0};
  other.radius_m = 0.35;
  bodies_.push_back(other);
  SimulatedVehicle vehicle(parameters_, {4, 5, 0});
  drive(vehicle, {1.0, 0, 0}, now_ + seconds(5));
  EXPECT_EQ(vehicle.hold(), Hold::kContact);
  EXPECT_NEAR(vehicle.base_in_map().x, 6.0 - 0.7, 0.01);
}

TEST_F(Vehicle, APersonWhoWalksIntoItDoesNotTrapIt) {
  SimulatedVehicle vehicle(parameters_, {4, 5, 0});
  geometry::Body person;
  person.base_in_map = {4.3, 5.0, 0.0};  // overlaps its front
  person.radius_m = 0.25;
  bodies_.push_back(person);
  drive(vehicle, {-0.3, 0, 0}, now_ + seconds(3));
  EXPECT_LT(vehicle.base_in_map().x, 3.6);
}

TEST_F(Vehicle, TheBorderOfTheMapIsAWall) {
  SimulatedVehicle vehicle(parameters_, {38, 5, 0});
  drive(vehicle, {1.2, 0, 0}, now_ + seconds(6));
  EXPECT_LE(vehicle.base_in_map().x, 40.0 - parameters_.radius_m + 1e-9);
}

TEST_F(Vehicle, DoesNotMoveWhileItsSimulationStoodStill) {
  SimulatedVehicle vehicle(parameters_, {2, 5, 0});
  drive(vehicle, {1.2, 0, 0}, now_ + seconds(3));
  const double before = vehicle.base_in_map().x;
  now_ += seconds(5);
  vehicle.advance_to(now_, {walls_, bodies_});
  EXPECT_NEAR(vehicle.base_in_map().x, before, 0.01);
  EXPECT_EQ(vehicle.hold(), Hold::kLateCommand);
}

TEST_F(Vehicle, TheSameWhateverTheTick) {
  const auto end_of = [&](milliseconds tick) {
    SimulatedVehicle vehicle(parameters_, {2, 5, 0});
    time::Stamp next_command = seconds(100);
    for (time::Stamp t = seconds(100); t <= seconds(103); t += tick) {
      for (; next_command <= t; next_command += milliseconds(20)) vehicle.command({0.9, 0.3, 0}, next_command);
      vehicle.advance_to(t, {walls_, bodies_});
    }
    return vehicle.base_in_map();
  };
  const geometry::Pose2 fine = end_of(milliseconds(5));
  const geometry::Pose2 coarse = end_of(milliseconds(20));
  EXPECT_NEAR(fine.x, coarse.x, 0.02);
  EXPECT_NEAR(fine.y, coarse.y, 0.02);
}

TEST(PoseNoise, HasTheGivenSpreadAndIsTheSameForASeed) {
  Parameters parameters;
  std::mt19937_64 random(7);
  std::mt19937_64 again(7);
  double sum2 = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const geometry::Pose2 pose = with_noise({1, 2, 3}, parameters, random);
    EXPECT_EQ(pose.position(), with_noise({1, 2, 3}, parameters, again).position());
    sum2 += (pose.x - 1) * (pose.x - 1);
  }
  EXPECT_NEAR(std::sqrt(sum2 / 2000), parameters.pose_noise_m, 0.001);
}

TEST_F(Vehicle, ATricycleSteersWithinItsRateAndCannotTurnOnTheSpot) {
  parameters_.limits.model = kinematics::Model::kTricycle;
  parameters_.dead_time_s = 0.0;
  SimulatedVehicle vehicle(parameters_, {5, 5, 0});
  drive(vehicle, {0.0, 1.0, 0}, seconds(102));
  EXPECT_EQ(vehicle.base_in_map().yaw, 0.0);
  const time::Stamp begin = now_;
  drive(vehicle, {0.4, 0.4, 0}, begin + milliseconds(500));
  EXPECT_NEAR(vehicle.steering_rad(), 0.5 * parameters_.limits.axle.max_steering_rate_radps, 0.03);
  drive(vehicle, {0.4, 0.4, 0}, begin + seconds(4));
  EXPECT_NEAR(vehicle.steering_rad(), std::atan(1.5), 1e-6) << "tan(delta) = wheelbase / radius, 1 m";
  EXPECT_NEAR(vehicle.twist().angular_radps, 0.4, 1e-6);
  drive(vehicle, {}, begin + seconds(6));
  EXPECT_NEAR(vehicle.steering_rad(), std::atan(1.5), 1e-6) << "the wheel stays where it points";
}

TEST_F(Vehicle, ALongOneStopsWithItsNoseAtTheWallAndItsCornerWhenItTurns) {
  parameters_.length_m = 2.0;
  parameters_.width_m = 0.8;
  parameters_.ahead_m = 0.5;
  SimulatedVehicle vehicle(parameters_, {36, 5, 0});
  drive(vehicle, {0.5, 0, 0}, seconds(110));
  EXPECT_EQ(vehicle.hold(), Hold::kContact);
  EXPECT_NEAR(vehicle.base_in_map().x, 40.0 - 1.5, 0.01);
  SimulatedVehicle turning(parameters_,
                           {20, 9.5, 0});  // 0.5 m below the border, half as wide as 0.8 m, 1.5 m to its nose
  drive(turning, {0, 0.5, 0}, now_ + seconds(5));
  EXPECT_GE(turning.contacts(), 1U);
  EXPECT_LT(turning.base_in_map().yaw, 0.2);
}

TEST_F(Vehicle, AnOmnidirectionalOneGoesSideways) {
  parameters_.limits.model = kinematics::Model::kOmnidirectional;
  SimulatedVehicle vehicle(parameters_, {5, 5, 0});
  drive(vehicle, {0, 0, 0.5}, seconds(104));
  EXPECT_NEAR(vehicle.base_in_map().x, 5.0, 1e-9);
  EXPECT_GT(vehicle.base_in_map().y, 6.0);
}

}  // namespace
}  // namespace aisle::fake_vehicle
