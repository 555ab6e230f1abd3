// Is a vehicle where it was granted to be?
#include "tools/referee/core/grant_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace aisle::referee {
namespace {

using geometry::Point2;

/// A vehicle that drives by plan 5, a straight way of 10 m along x, of which 4 m are granted.
class Granted : public testing::Test {
 protected:
  Granted() {
    watch_.plan_arrived("agv-1", 5, {{0.0, 0.0}, {10.0, 0.0}}, true);
    watch_.grant_arrived("agv-1", 5, 4.0);
    drive_by(5);
  }

  void drive_by(std::uint64_t plan_id) {
    VehicleReport report;
    report.agv_id = "agv-1";
    report.command_agv_id = "agv-1";
    report.command_plan_id = plan_id;
    watch_.vehicle_reported(report);
  }

  /// Drives to `to` at 1 m/s, straight.
  void drive_to(Point2 to) {
    while (geometry::distance(at_, to) > 1e-9) {
      const Point2 left = to - at_;
      at_ = at_ + std::min(1.0, 0.02 / geometry::norm(left)) * left;
      watch_.vehicle_seen("agv-1", at_, now_s_ += 0.02);
    }
  }

  GrantWatch watch_;
  Point2 at_;
  double now_s_{0.0};
};

TEST_F(Granted, GoesToItsLimit) {
  drive_to({4.1, 0.05});
  EXPECT_TRUE(watch_.violations().empty());
}

TEST_F(Granted, IsBlamedOnceForGoingBeyondIt) {
  drive_to({5.0, 0.0});
  ASSERT_EQ(watch_.violations().size(), 1u);
  EXPECT_EQ(watch_.violations()[0].kind, AuthorityViolation::Kind::kBeyondGrant);
  EXPECT_NEAR(watch_.violations()[0].t_s, 4.2, 0.05);
  drive_to({6.0, 0.0});
  EXPECT_EQ(watch_.violations().size(), 1u);
}

TEST_F(Granted, GoesOnWithMoreRoadAndIsNotBlamedForRoadThatIsAskedBack) {
  watch_.grant_arrived("agv-1", 5, 8.0);
  drive_to({6.0, 0.0});
  watch_.grant_arrived("agv-1", 5, 5.0);
  drive_to({8.0, 0.0});
  EXPECT_TRUE(watch_.violations().empty());
}

TEST_F(Granted, IsJudgedByThePlanThatItDrivesBy) {
  watch_.plan_arrived("agv-1", 6, {{2.0, 0.0}, {2.0, 10.0}}, true);
  watch_.grant_arrived("agv-1", 6, 1.0);
  drive_to({2.0, 0.0});
  drive_by(6);
  drive_to({2.0, 1.1});
  EXPECT_TRUE(watch_.violations().empty());
  drive_to({2.0, 2.0});
  EXPECT_EQ(watch_.violations().size(), 1u);
}

TEST_F(Granted, HasNoLimitOnAPlanWithoutSteps) {
  watch_.plan_arrived("agv-1", 7, {{0.0, 0.0}, {10.0, 0.0}}, false);
  drive_by(7);
  drive_to({9.0, 0.0});
  EXPECT_TRUE(watch_.violations().empty());
}

/// The way comes back beside its beginning: what counts is how far along it the vehicle is.
TEST_F(Granted, IsFollowedAlongAWayThatComesBack) {
  watch_.plan_arrived("agv-1", 8, {{0.0, 0.0}, {6.0, 0.0}, {6.0, 1.0}, {0.0, 1.0}}, true);
  watch_.grant_arrived("agv-1", 8, 6.0);
  drive_by(8);
  drive_to({2.0, 0.45});
  drive_to({5.5, 0.45});
  EXPECT_TRUE(watch_.violations().empty());
}

/// It drives into a dead end and back: the way out lies over the way in.
TEST_F(Granted, IsNotTakenToBeOnItsWayBackTooSoon) {
  watch_.plan_arrived("agv-1", 9, {{0.0, 0.0}, {3.0, 0.0}, {0.0, 0.0}, {0.0, 5.0}}, true);
  watch_.grant_arrived("agv-1", 9, 3.0);
  drive_by(9);
  drive_to({1.5, 0.01});
  drive_to({2.9, -0.01});
  EXPECT_TRUE(watch_.violations().empty());
  drive_to({1.0, 0.0});
  ASSERT_EQ(watch_.violations().size(), 1u);
}

/// The way passes one place twice, within what is looked at when a plan begins: only the first pass is granted. The
/// vehicle, a little beside it, is nearer to the second.
TEST_F(Granted, IsOnTheGrantedPassWhereItsWayPassesTwice) {
  watch_.plan_arrived("agv-1", 10, {{0.0, 0.0}, {1.2, 0.0}, {1.2, 0.09}, {-3.0, 0.09}}, true);
  watch_.grant_arrived("agv-1", 10, 1.0);
  at_ = {0.9, 0.085};
  drive_by(10);
  drive_to({0.95, 0.085});
  for (int i = 0; i < 50; ++i) watch_.vehicle_seen("agv-1", at_, now_s_ += 0.02);
  EXPECT_TRUE(watch_.violations().empty());

  drive_to({1.2, 0.09});
  drive_to({0.5, 0.09});
  EXPECT_EQ(watch_.violations().size(), 1U) << "it has gone round the end";
}

}  // namespace
}  // namespace aisle::referee
