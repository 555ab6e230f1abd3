// A variant as its paper prints it: nothing of ours in between.
#include "services/local-planner/core/printed/printed_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "services/local-planner/core/speed_window.hpp"
#include "tests/unit/local-planner/drive.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// A drive as printed, with the vehicle of the paper.
class Printed : public Drive {
 public:
  Printed(const grid::OccupancyGrid& grid, Pose2 start, const Variant& variant)
      : Drive(grid, start, variant, settings()) {
    const PaperLimits& paper = variant.paper;
    kinematics::Limits limits;
    limits.max_speed_mps = paper.max_speed_mps;
    limits.max_reverse_mps = 0.0;
    limits.max_turn_radps = paper.max_turn_radps;
    limits.max_acceleration_mps2 = paper.max_acceleration_mps2;
    limits.max_deceleration_mps2 = paper.max_deceleration_mps2;
    limits.max_turn_acceleration_radps2 = paper.max_turn_acceleration_radps2;
    limits.model = variant.printed.model;
    inputs.vehicle->limits = limits;
    inputs.vehicle->footprint = geometry::disc(variant.printed.radius_m);
  }

  void give_printed_plan(std::vector<Point2> waypoints) {
    give_plan(std::move(waypoints));
    inputs.plan->position_tolerance_m = 0.5;
  }

  static Settings settings() {
    Settings settings;
    settings.as_printed = true;
    return settings;
  }
};

Scene scene_at(const grid::ClearanceField& clearance, const kinematics::Limits& limits, const geometry::Twist2& twist) {
  static const std::vector<Mover> kNobody;
  static const std::vector<PeerMotion> kNone;
  return {clearance, {5.0, 5.0, 0.0}, twist, 0.2, limits, limits.max_speed_mps, kNobody, kNone};
}

TEST(PrintedWindow, HoldsWhatOneIntervalReachesAtThePapersResolution) {
  const grid::ClearanceField clearance(hall(10.0, 10.0));
  const Variant& qu = *find_variant("qu");
  kinematics::Limits limits;
  limits.max_speed_mps = qu.paper.max_speed_mps;
  limits.max_turn_radps = qu.paper.max_turn_radps;
  limits.max_acceleration_mps2 = qu.paper.max_acceleration_mps2;
  limits.max_deceleration_mps2 = qu.paper.max_deceleration_mps2;
  limits.max_turn_acceleration_radps2 = qu.paper.max_turn_acceleration_radps2;
  double least_mps = 1e9, most_mps = 0.0, least_radps = 1e9, most_radps = -1e9;
  std::set<double> speeds;
  for (const geometry::Twist2& twist :
       speed_window(scene_at(clearance, limits, {1.0, 0.0, 0.0}), printed_window({}, qu))) {
    least_mps = std::min(least_mps, twist.linear_mps), most_mps = std::max(most_mps, twist.linear_mps);
    least_radps = std::min(least_radps, twist.angular_radps), most_radps = std::max(most_radps, twist.angular_radps);
    speeds.insert(twist.linear_mps);
  }
  EXPECT_NEAR(least_mps, 0.96, 1e-9);
  EXPECT_NEAR(most_mps, 1.04, 1e-9);
  EXPECT_NEAR(least_radps, -from_degrees(6.0), 1e-9);
  EXPECT_NEAR(most_radps, from_degrees(6.0), 1e-9);
  EXPECT_GE(speeds.size(), 9u) << "every 0.01 m/s";
  EXPECT_LE(speeds.size(), 10u);
}

/// The paper's vehicle, without its model.
kinematics::Limits limits_of(const PaperLimits& paper) {
  kinematics::Limits limits;
  limits.max_speed_mps = paper.max_speed_mps;
  limits.max_turn_radps = paper.max_turn_radps;
  limits.max_acceleration_mps2 = paper.max_acceleration_mps2;
  limits.max_deceleration_mps2 = paper.max_deceleration_mps2;
  limits.max_turn_acceleration_radps2 = paper.max_turn_acceleration_radps2;
  return limits;
}

/// The greatest speed and turn rate of a paper's window, and how many speeds it holds.
struct WindowEnds {
  double most_mps{0.0}, most_radps{0.0};
  std::set<double> speeds;
};

WindowEnds ends_of(const Variant& variant, const geometry::Twist2& now) {
  static const grid::ClearanceField clearance(hall(10.0, 10.0));
  WindowEnds ends;
  for (const geometry::Twist2& twist :
       speed_window(scene_at(clearance, limits_of(variant.paper), now), printed_window({}, variant))) {
    ends.most_mps = std::max(ends.most_mps, twist.linear_mps);
    ends.most_radps = std::max(ends.most_radps, twist.angular_radps);
    ends.speeds.insert(twist.linear_mps);
  }
  return ends;
}

// V_s, V_x, V_m: a vehicle at its limits is offered nothing beyond.
TEST(PrintedWindow, EndsAtThePapersLimits) {
  for (const char* name : {"li", "qu", "yu", "wang"}) {
    const Variant& variant = *find_variant(name);
    const PaperLimits& paper = variant.paper;
    const WindowEnds ends = ends_of(variant, {paper.max_speed_mps, paper.max_turn_radps, 0.0});
    EXPECT_NEAR(ends.most_mps, paper.max_speed_mps, 1e-9) << name;
    EXPECT_NEAR(ends.most_radps, paper.max_turn_radps, 1e-9) << name;
  }
}

TEST(PrintedWindow, OfWangIsSampledEveryFiveCentimetresASecond) {
  const WindowEnds ends = ends_of(wang(), {0.5, 0.0, 0.0});
  EXPECT_NEAR(ends.most_mps, 0.6, 1e-9) << "1 m/s^2 for 0.1 s";
  EXPECT_NEAR(ends.most_radps, from_degrees(5.0), 1e-9) << "50 deg/s^2 for 0.1 s";
  std::set<long> hundredths;
  for (const double speed : ends.speeds) hundredths.insert(std::lround(100.0 * speed));
  EXPECT_EQ(hundredths, (std::set<long>{40, 45, 50, 55, 60}));
}

// heading and dist-2 are of the end of the trajectory; our own drive looks after 0.8 s.
TEST(PrintedWindow, LooksAtTheEndOfThePapersTrajectory) {
  for (const char* name : {"li", "wu", "qu", "yu", "wang"}) {
    const DwaSettings window = printed_window({}, *find_variant(name));
    EXPECT_EQ(window.horizon_s, find_variant(name)->paper.horizon_s) << name;
    EXPECT_EQ(window.look_step(), window.steps()) << name;
    EXPECT_EQ(window.step_s, 0.1) << name;
  }
  EXPECT_LT(DwaSettings{}.look_step(), DwaSettings{}.steps());
}

TEST(PrintedWindow, OfAForkliftHoldsOnlyWhatItsWheelCanSteer) {
  const grid::ClearanceField clearance(hall(10.0, 10.0));
  const Variant& wu = *find_variant("wu");
  kinematics::Limits limits;
  limits.max_speed_mps = 1.0;
  limits.max_turn_radps = 0.35;
  limits.max_acceleration_mps2 = limits.max_deceleration_mps2 = 0.2;
  limits.max_turn_acceleration_radps2 = 0.9;
  limits.model = kinematics::Model::kTricycle;
  const double steepest = std::tan(limits.axle.max_steering_rad) / limits.axle.wheelbase_m;
  for (const geometry::Twist2& twist :
       speed_window(scene_at(clearance, limits, {0.1, 0.0, 0.0}), printed_window({}, wu)))
    EXPECT_LE(std::abs(twist.angular_radps), twist.linear_mps * steepest + 1e-9);
}

TEST(PrintedPlanner, YuTurnsToTheFirstNodeBeforeItMoves) {
  Printed drive(hall(20.0, 10.0), {3.0, 5.0, 2.0}, *find_variant("yu"));
  drive.give_printed_plan({{3.0, 5.0}, {10.0, 5.0}, {16.0, 7.0}});
  double farthest_m = 0.0;
  ASSERT_TRUE(drive.until(30.0, [&] {
    const bool faces_it = std::abs(geometry::wrap(drive.base.yaw)) < from_degrees(3.0);
    if (!faces_it) farthest_m = std::max(farthest_m, geometry::distance(drive.base.position(), {3.0, 5.0}));
    return faces_it && drive.twist.linear_mps > 0.0;
  })) << drive.base.yaw;
  EXPECT_LT(farthest_m, 1e-3);
}

TEST(PrintedPlanner, WangDoesNotTurnOnTheSpotButDrivesOn) {
  Printed drive(hall(20.0, 10.0), {3.0, 5.0, 0.5}, wang());
  drive.give_printed_plan({{3.0, 5.0}, {10.0, 5.0}, {16.0, 7.0}});
  drive.run(1.0);
  EXPECT_EQ(drive.output.phase, Phase::kDriving);
  EXPECT_GT(drive.twist.linear_mps, 0.3);
}

// Our own drive slows where walls are near; as printed there is no speed profile.
TEST(PrintedPlanner, DoesNotSlowBetweenWalls) {
  const auto top_speed = [&](Drive& drive) {
    double most_mps = 0.0;
    drive.until(8.0, [&] {
      most_mps = std::max(most_mps, drive.twist.linear_mps);
      return false;
    });
    return most_mps;
  };
  Printed printed(aisle(0.8), {2.0, 5.0, 0.0}, wang());
  printed.give_printed_plan({{2.0, 5.0}, {18.0, 5.0}});
  Drive ours(aisle(0.8), {2.0, 5.0, 0.0}, wang());
  ours.inputs.vehicle = printed.inputs.vehicle;
  ours.give_plan({{2.0, 5.0}, {18.0, 5.0}});
  EXPECT_GT(top_speed(printed), top_speed(ours) + 0.2);
}

// WANG aims at the turning point itself; our own drive rounds the turn on its lane.
TEST(PrintedPlanner, DrivesAtTheTurningPointUntilItIsNear) {
  Printed drive(hall(20.0, 20.0), {2.0, 5.0, 0.0}, wang());
  drive.give_printed_plan({{2.0, 5.0}, {10.0, 5.0}, {10.0, 15.0}});
  ASSERT_TRUE(drive.until(40.0, [&] { return drive.base.y > 5.1; }));
  EXPECT_GT(drive.base.x, 9.0 - 0.05) << "no turn begins before the point is 1 m away";
  EXPECT_TRUE(drive.until(60.0, Phase::kArrived));
}

// Not YU: its weight of the speed, ten times that of the heading, may lead it past the goal in circles; whether it
// does is a finding (printed_drive_test.cpp).
TEST(PrintedPlanner, TheOthersArriveAtAGoalStraightAhead) {
  for (const char* name : {"dwa", "li", "qu", "wang", "wu"}) {
    Printed drive(hall(20.0, 10.0), {3.0, 5.0, 0.0}, *find_variant(name));
    drive.give_printed_plan({{3.0, 5.0}, {16.0, 5.0}});
    EXPECT_TRUE(drive.until(60.0, Phase::kArrived)) << name << " at " << drive.base.x << ", " << drive.base.y;
    EXPECT_LE(geometry::distance(drive.base.position(), {16.0, 5.0}), 0.55) << name;
  }
}

TEST(PrintedPlanner, OnceThereItStaysThereAndBrakes) {
  Printed drive(hall(20.0, 10.0), {3.0, 5.0, 0.0}, wang());
  drive.give_printed_plan({{3.0, 5.0}, {10.0, 5.0}});
  ASSERT_TRUE(drive.until(60.0, Phase::kArrived));
  EXPECT_GT(drive.twist.linear_mps, 0.5) << "no paper slows before its goal";
  EXPECT_TRUE(drive.stops_within(3.0));
  EXPECT_EQ(drive.output.phase, Phase::kArrived);
  drive.give_plan({{drive.base.x, 5.0}, {16.0, 5.0}}, "goal-2");
  drive.run(0.2);
  EXPECT_EQ(drive.output.phase, Phase::kDriving);
}

TEST(PrintedPlanner, WuLeavesThePathForABoxAndComesBack) {
  Printed drive(hall(20.0, 10.0), {2.0, 5.0, 0.0}, *find_variant("wu"));
  drive.give_printed_plan({{2.0, 5.0}, {18.0, 5.0}});
  double beside_m = 0.0, least_m = 1e9;
  bool avoided = false;
  ASSERT_TRUE(
      drive.until(90.0,
                  [&] {
                    drive.inputs.tracks = {drive.track({9.0, 5.0}, {}, true)};
                    avoided = avoided || drive.output.sub_target_in_map.has_value();
                    beside_m = std::max(beside_m, std::abs(drive.base.y - 5.0));
                    least_m = std::min(least_m, geometry::distance(drive.base.position(), {9.0, 5.0}) - 0.2 - 0.25);
                    return drive.output.phase == Phase::kArrived;
                  }))
      << drive.base.x << ", " << drive.base.y;
  EXPECT_TRUE(avoided);
  EXPECT_GT(beside_m, 0.3);
  EXPECT_GT(least_m, 0.0);
}

TEST(PrintedPlanner, IsStoppedByWhatStopsOurOwn) {
  Printed drive(hall(20.0, 10.0), {3.0, 5.0, 0.0}, wang());
  drive.give_printed_plan({{3.0, 5.0}, {16.0, 5.0}});
  drive.run(2.0);
  drive.state_comes = false;
  drive.run(0.5);
  EXPECT_EQ(drive.output.phase, Phase::kHeld);
  EXPECT_EQ(drive.output.reason, Reason::kStaleState);
}

TEST(PrintedPlanner, KeepsAChoiceForOneInterval) {
  Printed drive(hall(20.0, 10.0), {3.0, 5.0, 0.0}, wang());
  drive.give_printed_plan({{3.0, 5.0}, {16.0, 5.0}});
  drive.cycle();
  const double first_mps = drive.output.twist.linear_mps;
  EXPECT_NEAR(first_mps, 1.0 * 0.02, 1e-9) << "of the 0.1 m/s that were chosen for 0.1 s";
  const auto cycle_before_a_box = [&] {  // which leaves no room to move at all
    drive.inputs.tracks = {drive.track({drive.base.x + 0.46, 5.0}, {}, true)};
    drive.cycle();
  };
  for (int i = 0; i < 4; ++i) cycle_before_a_box();
  EXPECT_NEAR(drive.output.twist.linear_mps, 0.1, 1e-9) << "chosen before there was a box";
  cycle_before_a_box();
  EXPECT_LT(drive.output.twist.linear_mps, 0.1) << "chosen anew";
}

TEST(MakePlanner, GivesTheSitesOwnUnlessAsPrinted) {
  EXPECT_EQ(dynamic_cast<PrintedPlanner*>(make_planner({}, wang()).get()), nullptr);
  EXPECT_NE(dynamic_cast<PrintedPlanner*>(make_planner(Printed::settings(), wang()).get()), nullptr);
}

}  // namespace
}  // namespace aisle::local_planner
