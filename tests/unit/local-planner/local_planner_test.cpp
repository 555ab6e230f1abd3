#include "services/local-planner/core/local_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>

#include "tests/unit/local-planner/drive.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;
using time::from_seconds;

TEST(LocalPlanner, DrivesToTheGoalAndStaysThere) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {10.0, 5.0}, {16.0, 7.0}});
  ASSERT_TRUE(drive.until(40.0, Phase::kArrived));
  EXPECT_LT(geometry::distance(drive.base.position(), {16.0, 7.0}), 0.15);
  const Pose2 there = drive.base;
  drive.run(3.0);
  EXPECT_EQ(drive.output.phase, Phase::kArrived);
  EXPECT_LT(geometry::distance(drive.base.position(), there.position()), 1e-6);
  EXPECT_DOUBLE_EQ(drive.output.distance_left_m, 0.0);
}

TEST(LocalPlanner, NeverChangesSpeedFasterThanTheVehicleCan) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {10.0, 5.0}, {10.0, 8.0}});
  const kinematics::Limits limits;
  Twist2 before;
  drive.until(30.0, [&] {
    const Twist2 command = drive.output.twist;
    EXPECT_LE(command.linear_mps - before.linear_mps, limits.max_acceleration_mps2 * 0.02 + 1e-9);
    EXPECT_LE(before.linear_mps - command.linear_mps, limits.max_deceleration_mps2 * 0.02 + 1e-9);
    EXPECT_LE(std::abs(command.angular_radps - before.angular_radps),
              limits.max_turn_acceleration_radps2 * 0.02 + 1e-9);
    before = command;
    return drive.output.phase == Phase::kArrived;
  });
}

TEST(LocalPlanner, TurnsOnTheSpotWhenTheWayLeadsBack) {
  Drive drive(hall(20.0, 10.0), {10.0, 5.0, 0.0});
  drive.give_plan({{10.0, 5.0}, {3.0, 5.0}});
  drive.cycle();
  EXPECT_EQ(drive.output.phase, Phase::kTurning);
  double farthest = 10.0;
  ASSERT_TRUE(drive.until(30.0, [&] {
    farthest = std::max(farthest, drive.base.x);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_LT(farthest, 10.2);
}

TEST(LocalPlanner, IsThereWithinTheToleranceWhenSomebodyStandsAtTheGoal) {
  for (const geometry::Point2 off : {geometry::Point2{0.60, 0.0}, {0.66, 0.0}, {0.55, 0.23}}) {
    Drive drive(hall(20.0, 10.0));
    drive.give_plan({{3.0, 5.0}, {12.0, 5.0}});
    const bool arrived = drive.until(40.0, [&] {
      drive.inputs.tracks = {drive.track(geometry::Point2{12.0, 5.0} + off, {}, true)};
      return drive.output.phase == Phase::kArrived;
    });
    EXPECT_TRUE(arrived) << off.x << " " << off.y;
    EXPECT_LE(geometry::distance(drive.base.position(), {12.0, 5.0}), drive.inputs.plan->position_tolerance_m);
  }
}

TEST(LocalPlanner, TurnsToTheGoalsHeadingWhenItMatters) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {9.0, 5.0}});
  drive.inputs.plan->goal_in_map.yaw = -2.0;
  drive.inputs.plan->yaw_tolerance_rad = 0.1;
  ASSERT_TRUE(drive.until(40.0, Phase::kArrived));
  EXPECT_NEAR(drive.base.yaw, -2.0, 0.1);
  EXPECT_LT(geometry::distance(drive.base.position(), {9.0, 5.0}), 0.15);
}

TEST(LocalPlanner, DoesNotDither) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {16.0, 5.0}});
  int changes = 0;
  double last = 0.0;
  ASSERT_TRUE(drive.until(40.0, [&] {
    const double w = drive.twist.angular_radps;
    if (std::abs(w) > 0.05) {
      if (w * last < 0.0) ++changes;
      last = w;
    }
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_LE(changes, 8);
}

TEST(LocalPlanner, GoesOnToTheNextGoal) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {6.0, 5.0}});
  ASSERT_TRUE(drive.until(20.0, Phase::kArrived));
  drive.give_plan({{6.0, 5.0}, {9.0, 5.0}}, "goal-2");
  drive.cycle();
  EXPECT_NE(drive.output.phase, Phase::kArrived);
  EXPECT_TRUE(drive.until(20.0, Phase::kArrived));
}

// ---- What is missing or old stops it, with a name.

TEST(LocalPlannerGuard, SaysWhatItWaitsFor) {
  Drive drive(hall(20.0, 10.0));
  const auto expect = [&](Phase phase, Reason reason) {
    drive.cycle();
    EXPECT_EQ(drive.output.phase, phase) << name(drive.output.phase);
    EXPECT_EQ(drive.output.reason, reason) << name(drive.output.reason);
    EXPECT_EQ(drive.output.twist.linear_mps, 0.0);
    EXPECT_EQ(drive.output.twist.angular_radps, 0.0);
  };
  const grid::ClearanceField* map = std::exchange(drive.inputs.clearance, nullptr);
  drive.state_comes = drive.tracker_lives = false;
  expect(Phase::kWaiting, Reason::kNoState);
  drive.state_comes = true;
  expect(Phase::kWaiting, Reason::kNoMap);
  drive.inputs.clearance = map;
  expect(Phase::kWaiting, Reason::kNoGoal);
  drive.give_plan({{3.0, 5.0}, {9.0, 5.0}});
  expect(Phase::kWaiting, Reason::kNoTracker);
  drive.tracker_lives = true;
  drive.inputs.plan->outcome = fleet::PlanOutcome::kNoPath;
  drive.inputs.plan->waypoints_in_map.clear();
  drive.inputs.plan->detail = "the goal is in a wall";
  expect(Phase::kFailed, Reason::kUnreachable);
  EXPECT_EQ(drive.output.detail, "the goal is in a wall");
}

struct Fault {
  const char* name;
  std::function<void(Drive&)> make;
  Phase phase;
  Reason reason;
  double noticed_s;
};

class LocalPlannerFault : public testing::TestWithParam<Fault> {};

TEST_P(LocalPlannerFault, BrakesAtOnceAndNamesIt) {
  Drive drive(hall(40.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});
  drive.run(4.0);
  ASSERT_GT(drive.twist.linear_mps, 1.1);
  const double begun_m = drive.base.x;
  GetParam().make(drive);
  ASSERT_TRUE(drive.until(GetParam().noticed_s + 0.05, [&] { return drive.output.reason == GetParam().reason; }))
      << name(drive.output.reason);
  EXPECT_EQ(drive.output.phase, GetParam().phase);
  EXPECT_TRUE(drive.stops_within(1.5));
  EXPECT_LT(drive.base.x - begun_m, 1.2 * (GetParam().noticed_s + 0.25) + 1.2 * 1.2 / 2.4 * 1.05);
  drive.run(1.0);
  EXPECT_EQ(drive.output.twist.linear_mps, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, LocalPlannerFault,
    testing::Values(
        Fault{"StaleState", [](Drive& d) { d.state_comes = false; }, Phase::kHeld, Reason::kStaleState, 0.22},
        Fault{"StaleTracker", [](Drive& d) { d.tracker_lives = false; }, Phase::kHeld, Reason::kStaleTracker, 0.52},
        Fault{"BlindOnThisVehicle", [](Drive& d) { d.lidar_lives = false; }, Phase::kHeld, Reason::kStaleTracker, 0.52},
        Fault{"Cancelled", [](Drive& d) { d.inputs.plan->outcome = fleet::PlanOutcome::kCancelled; }, Phase::kHeld,
              Reason::kCancelled, 0.02},
        Fault{"HeldByAPerson", [](Drive& d) { d.inputs.is_held_by_person = true; }, Phase::kHeld, Reason::kPerson,
              0.02},
        Fault{"Authority", [](Drive& d) { d.inputs.authority_lost = true; }, Phase::kHeld, Reason::kAuthority, 0.02},
        Fault{"PlanOutdated", [](Drive& d) { d.inputs.map_revision = 2; }, Phase::kHeld, Reason::kPlanOutdated, 0.54}),
    [](const auto& fault) { return fault.param.name; });

TEST(LocalPlannerGuard, TellsABlindVehicleFromADeadTracker) {
  Drive blind(hall(20.0, 10.0)), alone(hall(20.0, 10.0));
  for (Drive* drive : {&blind, &alone}) drive->give_plan({{3.0, 5.0}, {16.0, 5.0}}), drive->run(1.0);
  blind.lidar_lives = false;
  alone.tracker_lives = false;
  for (Drive* drive : {&blind, &alone}) drive->run(1.0);
  EXPECT_EQ(blind.output.detail, "the tracker works, but has no fresh scan of agv-1");
  EXPECT_EQ(alone.output.detail, "");
}

TEST(LocalPlannerGuard, GoesOnSlowlyWhileTheMapIsNewerThanThePlan) {
  Drive drive(hall(40.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});
  drive.run(4.0);
  drive.inputs.map_revision = 2;
  drive.run(0.4);
  EXPECT_EQ(drive.output.phase, Phase::kDriving);
  EXPECT_LT(drive.output.twist.linear_mps, 1.0);
  drive.inputs.plan->map_revision = 2;  // the planner looked at it, and kept it
  drive.run(3.0);
  EXPECT_GT(drive.twist.linear_mps, 1.0);
  EXPECT_EQ(drive.output.phase, Phase::kDriving);
}

TEST(LocalPlannerGuard, StandsForAWhileAfterALateCycle) {
  Drive drive(hall(40.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});
  drive.run(4.0);
  drive.now += std::chrono::seconds(5);  // stopped by somebody, e.g. SIGSTOP; meanwhile the vehicle has braked
  drive.twist = {};
  drive.cycle();
  EXPECT_EQ(drive.output.phase, Phase::kHeld);
  EXPECT_EQ(drive.output.reason, Reason::kLate);
  EXPECT_EQ(drive.output.twist.linear_mps, 0.0);
  EXPECT_TRUE(drive.until(2.0, Phase::kDriving));
}

TEST(LocalPlanner, GoesOnAlongAPlanThatWasKept) {
  Drive drive(hall(40.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});
  ASSERT_TRUE(drive.until(40.0, [&] { return drive.base.x > 20.0; }));
  drive.inputs.map_revision = drive.inputs.plan->map_revision = 2;
  double least = drive.base.x;
  ASSERT_TRUE(drive.until(40.0, [&] {
    least = std::min(least, drive.base.x);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(least, 19.9);
}

/// Down an aisle and back: the lanes lie 0.9 m apart, so the nearest point of the plan's beginning is not where the
/// vehicle is.
const std::vector<Point2> kThereAndBack{{2.5, 4.6}, {17.0, 5.0}, {3.5, 5.6}};

/// Until it is on its way back, beside the plan's beginning.
bool is_nearly_back(Drive& drive) {
  drive.give_plan(kThereAndBack);
  return drive.until(60.0, [&] { return drive.base.x > 16.0; }) &&
         drive.until(60.0, [&] { return drive.base.x < 6.0; });
}

void expect_to_go_on(Drive& drive) {
  const double left_m = drive.output.distance_left_m;
  drive.cycle();
  EXPECT_NEAR(drive.output.distance_left_m, left_m, 0.5);
  double most_x = drive.base.x;
  EXPECT_TRUE(drive.until(40.0, [&] {
    most_x = std::max(most_x, drive.base.x);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_LT(most_x, 8.0) << "began the plan anew";
}

TEST(LocalPlanner, GoesOnAlongAPlanThatLeadsBackWhenTheMapIsEdited) {
  Drive drive(aisle(2.4), {2.5, 4.6, 0.0});
  ASSERT_TRUE(is_nearly_back(drive)) << drive.base.x;
  drive.inputs.map_revision = drive.inputs.plan->map_revision = 2;
  expect_to_go_on(drive);
}

TEST(LocalPlanner, GoesOnAlongAPlanThatAnotherPlannerTookOver) {
  Drive drive(aisle(2.4), {2.5, 4.6, 0.0});
  ASSERT_TRUE(is_nearly_back(drive)) << drive.base.x;
  drive.give_plan(kThereAndBack);  // the same under another id
  expect_to_go_on(drive);
}

TEST(LocalPlanner, TakesANewPathUnderAnOldId) {
  Drive drive(hall(40.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});
  drive.run(2.0);
  drive.inputs.plan->waypoints_in_map = {
      {3.0, 5.0}, {20.0, 8.5}, {37.0, 5.0}};  // ids of a planner that was restarted begin again
  double most_y = 0.0;
  ASSERT_TRUE(drive.until(60.0, [&] {
    most_y = std::max(most_y, drive.base.y);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(most_y, 7.0);
}

TEST(LocalPlanner, FindsItsPlaceOnAPlanAfterARestart) {
  Drive drive(hall(40.0, 10.0), {20.0, 4.5, 0.0});
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});  // made when the vehicle stood at its start
  ASSERT_TRUE(drive.until(30.0, Phase::kArrived));
}

// ---- What is in the way.

TEST(LocalPlanner, DrivesAroundWhatStands) {
  Drive drive(aisle(3.0), {2.0, 5.0, 0.0});
  drive.give_plan({{2.0, 5.0}, {18.0, 5.0}});
  double least = 1e9;
  bool avoids = false;
  ASSERT_TRUE(drive.until(60.0, [&] {
    drive.inputs.tracks = {drive.track({10.0, 4.4}, {}, true)};
    least = std::min(least, geometry::distance(drive.base.position(), {10.0, 4.4}) - 0.35 - 0.25);
    avoids = avoids || drive.output.phase == Phase::kAvoiding;
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(least, 0.03);
  EXPECT_TRUE(avoids);
}

TEST(LocalPlanner, SaysWhereItIsBlockedWhenThereIsNoWayAround) {
  Drive drive(aisle(1.4), {2.0, 5.0, 0.0});
  drive.give_plan({{2.0, 5.0}, {18.0, 5.0}});
  ASSERT_TRUE(drive.until(60.0, [&] {
    drive.inputs.tracks = {drive.track({10.0, 5.0}, {}, true)};
    return drive.output.phase == Phase::kBlocked;
  }));
  EXPECT_EQ(drive.output.reason, Reason::kObstacle);
  EXPECT_NEAR(drive.output.blocked_at_in_map.x, 10.0, 1.2);
  EXPECT_GT(drive.output.blocked_radius_m, 0.0);
  EXPECT_LT(drive.base.x, 10.0 - 0.6);
}

TEST(LocalPlanner, StandsWhenAPersonComesTooNear) {
  // Who walks straight on into an aisle that is too narrow to pass: the vehicle must stand before they touch.
  for (const double speed : {0.8, 1.3, 1.8}) {
    Drive drive(aisle(1.4), {2.0, 5.0, 0.0});
    drive.give_plan({{2.0, 5.0}, {18.0, 5.0}});
    double fastest_at_contact = 0.0;
    double x = 16.0;
    drive.until(20.0, [&] {
      x -= 0.02 * speed;
      drive.inputs.tracks = {drive.track({x, 5.0}, {-speed, 0.0}, false)};
      const double gap = geometry::distance(drive.base.position(), {x, 5.0}) - 0.6;
      if (gap < 0.02) fastest_at_contact = std::max(fastest_at_contact, std::abs(drive.twist.linear_mps));
      return gap < -0.3;
    });
    EXPECT_LT(fastest_at_contact, 0.05) << speed;
  }
}

TEST(LocalPlanner, LetsAPersonCross) {
  Drive drive(hall(20.0, 20.0), {2.0, 10.0, 0.0});
  drive.give_plan({{2.0, 10.0}, {18.0, 10.0}});
  double y = 2.0;
  double least = 1e9;
  ASSERT_TRUE(drive.until(60.0, [&] {
    y += 0.02 * 1.2;
    drive.inputs.tracks = {drive.track({9.0, y}, {0.0, 1.2}, false)};
    least = std::min(least, geometry::distance(drive.base.position(), {9.0, y}) - 0.6);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(least, 0.1);
}

/// Beside somebody who has stood for 3 s it drives on; who stopped a moment ago may walk on at any moment.
TEST(LocalPlanner, SlowsBesideWhoeverStoppedAMomentAgo) {
  const auto fastest_beside = [](bool is_static) {
    Drive drive(hall(20.0, 20.0), {2.0, 10.0, 0.0});
    drive.give_plan({{2.0, 10.0}, {18.0, 10.0}});
    double fastest = 0.0;
    drive.until(60.0, [&] {
      drive.inputs.tracks = {drive.track({10.0, 11.0}, {}, is_static)};
      if (std::abs(drive.base.x - 10.0) < 0.3) fastest = std::max(fastest, drive.twist.linear_mps);
      return drive.output.phase == Phase::kArrived;
    });
    return fastest;
  };
  EXPECT_GT(fastest_beside(true), 0.9);
  EXPECT_LT(fastest_beside(false), 0.8);
}

/// Who came from elsewhere may set off again, however long they stood: right beside them it creeps.
TEST(LocalPlanner, CreepsBesideWhoeverHasWalkedThere) {
  const auto fastest_beside = [](Point2 first_seen_in_map) {
    Drive drive(aisle(1.7));
    const Point2 there{7.0, 5.6};
    drive.inputs.tracks = {drive.track(first_seen_in_map, {}, true)};
    drive.cycle();
    drive.give_plan({{3.0, 5.0}, {12.0, 5.0}});
    double fastest = 0.0;
    drive.until(60.0, [&] {
      drive.inputs.tracks = {drive.track(there, {}, true)};
      const double gap = geometry::distance(drive.base.position(), there) - 0.6;
      if (gap < 0.35) fastest = std::max(fastest, drive.twist.linear_mps);
      return drive.output.phase == Phase::kArrived;
    });
    EXPECT_EQ(drive.output.phase, Phase::kArrived);
    return fastest;
  };
  EXPECT_GT(fastest_beside({7.0, 5.6}), 0.3);
  EXPECT_LT(fastest_beside({9.0, 5.6}), 0.2);
}

TEST(LocalPlanner, ALongVehicleCreepsOnlyBesidePeopleWhoAreNearItsOutline) {
  Drive drive(hall(20.0, 10.0));
  drive.inputs.vehicle->footprint = geometry::rectangle(2.4, 1.1, 0.4);
  const Point2 there{10.0, 6.6};
  drive.inputs.tracks = {drive.track({10.0, 8.0}, {}, true)};
  drive.cycle();
  drive.give_plan({{3.0, 5.0}, {16.0, 5.0}});
  double slowest = 1e9;
  ASSERT_TRUE(drive.until(60.0, [&] {
    drive.inputs.tracks = {drive.track(there, {}, true)};
    if (std::abs(drive.base.x - there.x) < 1.0) slowest = std::min(slowest, drive.twist.linear_mps);
    return drive.output.phase == Phase::kArrived;
  }));
  EXPECT_GT(slowest, 0.3);
}

TEST(LocalPlanner, TellsTheWayThatItWillTake) {
  Drive drive(hall(40.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {37.0, 5.0}});
  drive.run(2.0);
  const auto intent = drive.output.intent;
  ASSERT_GE(intent.size(), 4U);
  EXPECT_LE(intent.size(), 8U);
  EXPECT_NEAR(intent.front().base_in_map.x, drive.base.x, 0.1);
  const double begun = time::seconds(drive.now);
  for (std::size_t i = 1; i < intent.size(); ++i) EXPECT_GE(intent[i].offset_s, intent[i - 1].offset_s);
  const auto later = std::find_if(intent.begin(), intent.end(), [](const IntentPoint& p) { return p.offset_s > 3.0; });
  ASSERT_NE(later, intent.end());
  drive.until(10.0, [&] { return time::seconds(drive.now) - begun >= later->offset_s; });
  EXPECT_LT(geometry::distance(drive.base.position(), later->base_in_map.position()), 0.5);
}

TEST(LocalPlanner, IsDeterministic) {
  const auto trace = [] {
    Drive drive(aisle(3.0), {2.0, 5.0, 0.3});
    drive.give_plan({{2.0, 5.0}, {18.0, 5.5}});
    drive.inputs.tracks = {drive.track({10.0, 4.4}, {}, true)};
    std::vector<double> values;
    drive.until(20.0, [&] {
      values.push_back(drive.base.x);
      values.push_back(drive.base.yaw);
      return false;
    });
    return values;
  };
  EXPECT_EQ(trace(), trace());
}

}  // namespace
}  // namespace aisle::local_planner
