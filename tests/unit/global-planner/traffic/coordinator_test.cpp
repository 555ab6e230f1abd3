// Who holds which floor, told by hand: vehicles say what they should, and times are invented.
#include "services/global-planner/core/traffic/coordinator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "tests/unit/global-planner/traffic/plan_world.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// A hall of 20 x 10 m at 0.1 m a cell, and carts that speak ten times a second.
class CoordinatorTest : public testing::Test {
 protected:
  CoordinatorTest() : grid_(grid::Geometry{200, 100, 0.1, {}}), clearance_(grid_) {
    coordinator_.set_map(clearance_, {0, 0}, {199, 99});
  }

  void arrive(const std::string& id, const Pose2& pose) {
    coordinator_.set_vehicle(id, test_support::cart());
    says_[id].agv_id = id;
    says_[id].base_in_map = pose;
  }

  void run(double seconds) {
    for (double left_s = seconds; left_s > 1e-9; left_s -= 0.1) {
      now_s_ += 0.1;
      for (const auto& [id, report] : says_) coordinator_.hear(report, now_s_);

      const Orders orders = coordinator_.step(now_s_);
      for (const Way& way : orders.ways) ways_[way.agv_id] = way;
      for (const GrantedRoad& grant : orders.grants) {
        if (grant.gives_back) ++asked_back_;
        grants_[grant.agv_id] = grant;
      }
    }
  }

  /// Where a step of the vehicle's newest way ends.
  Point2 end_of_step(const std::string& id, std::uint64_t step) {
    const Way& way = ways_.at(id);
    double left_m = way.step_ends_m.at(step - way.first_step);
    for (std::size_t i = 1; i < way.waypoints_in_map.size(); ++i) {
      const Point2 from = way.waypoints_in_map[i - 1], to = way.waypoints_in_map[i];
      const double leg_m = geometry::distance(from, to);
      if (left_m <= leg_m + 1e-9) return from + (left_m / leg_m) * (to - from);
      left_m -= leg_m;
    }
    return way.waypoints_in_map.back();
  }

  /// The vehicle has come to the end of the step before `done`, stands there, and obeys its newest grant.
  void stand_behind(const std::string& id, std::uint64_t done, std::uint64_t limit) {
    Report& report = says_.at(id);
    const Point2 at = done > ways_.at(id).first_step ? end_of_step(id, done - 1) : report.base_in_map.position();
    report.base_in_map = {at.x, at.y, report.base_in_map.yaw};
    report.plan_id = ways_.at(id).plan_id;
    report.step_done = done;
    report.limit_step = limit;
    report.grant_number = grants_.at(id).number;
  }

  bool holds(const std::string& id, Point2 at) {
    const auto holders = coordinator_.lock().holders("", standing_shape(test_support::cart(), {at.x, at.y, 0.0}));
    return std::find(holders.begin(), holders.end(), id) != holders.end();
  }

  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
  bool has_own_ways_{false};  // straight ones
  Coordinator coordinator_{Coordinator::Settings{}, [this](const std::string&, Point2 from_in_map, Point2 to_in_map) {
                             return has_own_ways_ ? std::vector<Point2>{from_in_map, to_in_map} : std::vector<Point2>{};
                           }};
  double now_s_{100.0};
  std::map<std::string, Report> says_;
  std::map<std::string, Way> ways_;
  std::map<std::string, GrantedRoad> grants_;  // the newest
  int asked_back_{0};                          // how often vehicles were asked for road
};

/// agv-1 has road ahead and drives; agv-2 stands far away, so that road is granted a few metres ahead only.
class ThingOnTheRoad : public CoordinatorTest {
 protected:
  ThingOnTheRoad() {
    arrive("agv-1", {2.0, 5.0, 0.0});
    arrive("agv-2", {18.0, 2.0, 0.0});
    coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
    run(1.0);
    first_ = ways_.at("agv-1").first_step;
    stand_behind("agv-1", first_, grants_.at("agv-1").limit_step);
    says_["agv-1"].speed_mps = 0.5;
  }

  /// In the middle of the third step, which is granted.
  void put_thing() {
    const Point2 at = end_of_step("agv-1", first_ + 2);
    coordinator_.set_standing("thing", Shape({{at, at, 0.2}}), now_s_);
  }

  std::uint64_t first_{0};
};

TEST_F(ThingOnTheRoad, RoadIsNotAskedBackForAThingThatGoesOnSoon) {
  ASSERT_GE(grants_.at("agv-1").limit_step, first_ + 3);
  put_thing();
  run(1.5);
  coordinator_.set_standing("thing", {}, now_s_);
  run(3.0);
  EXPECT_EQ(asked_back_, 0);
}

TEST_F(ThingOnTheRoad, RoadIsAskedBackForAThingThatStays) {
  put_thing();
  run(2.5);
  EXPECT_TRUE(grants_.at("agv-1").gives_back);
  EXPECT_LE(grants_.at("agv-1").limit_step, first_ + 2);
}

/// It answers each time that it cannot stop before the end of what it has.
TEST_F(ThingOnTheRoad, AVehicleThatCannotGiveBackIsAskedOnceASecondAtMost) {
  put_thing();
  for (int i = 0; i < 60; ++i) {
    run(0.1);
    says_["agv-1"].grant_number = grants_.at("agv-1").number;
  }
  EXPECT_GE(asked_back_, 2);
  EXPECT_LE(asked_back_, 5);
}

/// Only agv-1 is there. Something stands on its fourth step.
class ThingBeforeALoneVehicle : public CoordinatorTest {
 protected:
  void drive_towards_thing() {
    arrive("agv-1", {2.0, 5.0, 0.0});
    coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
    run(1.0);
    first_ = ways_.at("agv-1").first_step;
    stand_behind("agv-1", first_, grants_.at("agv-1").limit_step);
    says_["agv-1"].speed_mps = 0.5;

    const Point2 at = end_of_step("agv-1", first_ + 3);
    coordinator_.set_standing("thing", Shape({{at, at, 0.2}}), now_s_);
    run(3.5);
  }

  std::uint64_t first_{0};
};

TEST_F(ThingBeforeALoneVehicle, GivesBackAllThatItCanWhereThereIsAWayRound) {
  has_own_ways_ = true;
  drive_towards_thing();
  EXPECT_TRUE(grants_.at("agv-1").gives_back);
  EXPECT_EQ(grants_.at("agv-1").limit_step, first_ + 1) << "it drives the step that it is in";
}

TEST_F(ThingBeforeALoneVehicle, KeepsItsRoadWhereThereIsNone) {
  drive_towards_thing();
  EXPECT_EQ(asked_back_, 0) << "it drives on to the thing, and says so there";
}

/// agv-1 gives road back, and the floor at its new limit has been forced upon meanwhile by the road that agv-2 has from
/// an earlier leader: agv-1 goes on holding where it comes to stand, also when the steps to it are behind it.
TEST_F(CoordinatorTest, AVehicleHoldsWhereItStandsWhateverIsForcedUponIt) {
  arrive("agv-1", {2.0, 5.0, 0.0});
  coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
  run(1.0);
  const std::uint64_t first = ways_.at("agv-1").first_step;
  ASSERT_GE(grants_.at("agv-1").limit_step, first + 3);

  const Point2 stand = end_of_step("agv-1", first + 1);
  arrive("agv-2", {stand.x, 1.5, 0.0});
  says_["agv-2"].step_done = 4;
  says_["agv-2"].limit_step = 5;
  says_["agv-2"].held = {{{stand.x, 1.5, 0.0}, 4}, {{stand.x, 8.5, 0.0}, 4}};
  stand_behind("agv-1", first, grants_.at("agv-1").limit_step);
  run(0.2);
  ASSERT_TRUE(holds("agv-2", stand));

  says_["agv-1"].is_blocked = true;
  says_["agv-1"].blocked_at_in_map = {12.0, 5.0};
  says_["agv-1"].blocked_radius_m = 0.3;
  for (int i = 0; i < 50 && !grants_.at("agv-1").gives_back; ++i) run(0.1);
  ASSERT_TRUE(grants_.at("agv-1").gives_back);

  says_["agv-1"].speed_mps = 0.5;
  stand_behind("agv-1", first, first + 2);
  run(0.2);
  says_["agv-1"].speed_mps = 0.0;
  stand_behind("agv-1", first + 2, first + 2);
  run(0.2);
  EXPECT_TRUE(holds("agv-1", stand));
}

/// A vehicle that gives back the step that it is in keeps that step's floor until it stands.
TEST_F(CoordinatorTest, AVehicleThatStillMovesKeepsTheStepThatItIsIn) {
  arrive("agv-1", {2.0, 5.0, 0.0});
  arrive("agv-2", {18.0, 2.0, 0.0});
  coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
  run(1.0);
  const std::uint64_t first = ways_.at("agv-1").first_step;
  const Point2 end = end_of_step("agv-1", first);

  stand_behind("agv-1", first, grants_.at("agv-1").limit_step);
  says_["agv-1"].is_blocked = true;
  says_["agv-1"].blocked_at_in_map = {4.0, 5.0};
  says_["agv-1"].blocked_radius_m = 0.3;
  for (int i = 0; i < 50 && !grants_.at("agv-1").gives_back; ++i) run(0.1);
  ASSERT_TRUE(grants_.at("agv-1").gives_back);

  says_["agv-1"].is_blocked = false;
  says_["agv-1"].speed_mps = 0.3;
  stand_behind("agv-1", first, first);
  run(0.3);
  EXPECT_TRUE(holds("agv-1", end));

  says_["agv-1"].speed_mps = 0.0;
  says_["agv-1"].base_in_map.x += 0.4;
  run(0.3);
  EXPECT_TRUE(holds("agv-1", says_["agv-1"].base_in_map.position()));
  EXPECT_EQ(coordinator_.plans().agents().at("agv-1").done, first);
}

/// agv-1 was granted road to where agv-2 stands, before agv-2 was heard.
class Newcomer : public CoordinatorTest {
 protected:
  Newcomer() {
    arrive("agv-1", {2.0, 5.0, 0.0});
    arrive("agv-9", {18.0, 2.0, 0.0});
    coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
    run(1.0);
    first_ = ways_.at("agv-1").first_step;
    const Point2 there = end_of_step("agv-1", first_ + 1);
    stand_behind("agv-1", first_, grants_.at("agv-1").limit_step);
    arrive("agv-2", {there.x, there.y, 0.0});
    coordinator_.set_goal("agv-2", "goal-2", Pose2{15.0, 8.0, 0.0}, now_s_);
  }

  /// Does agv-2 have road?
  bool drives() const { return grants_.count("agv-2") > 0 && grants_.at("agv-2").limit_m > 0.0; }

  std::uint64_t first_{0};
};

TEST_F(Newcomer, IsNotGrantedRoadUntilOthersHaveGivenBackTheirsAroundIt) {
  run(3.0);
  EXPECT_TRUE(grants_.at("agv-1").gives_back);
  EXPECT_LE(grants_.at("agv-1").limit_step, first_ + 1);
  EXPECT_FALSE(drives());

  stand_behind("agv-1", first_, first_);
  run(3.0);
  EXPECT_TRUE(drives());
}

/// agv-1 has fallen silent with road ahead.
class SilentOnItsRoad : public CoordinatorTest {
 protected:
  SilentOnItsRoad() {
    arrive("agv-1", {2.0, 5.0, 0.0});
    arrive("agv-2", {18.0, 2.0, 0.0});
    coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
    run(1.0);
    first_ = ways_.at("agv-1").first_step;
    limit_ = grants_.at("agv-1").limit_step;
    stand_behind("agv-1", first_, limit_);
    word_ = says_.at("agv-1");
    word_.boot_id = 7;
    run(0.2);
    end_ = end_of_step("agv-1", limit_ - 1);

    says_.erase("agv-1");
    run(5.0);
    told_ = grants_.at("agv-1").number;
  }

  std::uint64_t first_{0}, limit_{0}, told_{0};
  Report word_;
  Point2 end_;
};

TEST_F(SilentOnItsRoad, SignedOffItHoldsAllThatItMayStillDrive) {
  ASSERT_GE(limit_, first_ + 2);
  EXPECT_TRUE(holds("agv-1", end_)) << "silence frees nothing";
  coordinator_.sign_off("agv-1", std::nullopt, word_, now_s_);
  run(5.0);
  EXPECT_TRUE(holds("agv-1", word_.base_in_map.position()));
  EXPECT_TRUE(holds("agv-1", end_));
  EXPECT_EQ(grants_.at("agv-1").number, told_) << "it is told nothing while it is silent";
}

TEST_F(SilentOnItsRoad, SignedOffWithAPlaceItHoldsThatUntilItIsHeardAgain) {
  const Point2 seen_at{4.0, 5.5};
  coordinator_.sign_off("agv-1", seen_at, word_, now_s_);
  run(5.0);
  EXPECT_TRUE(holds("agv-1", seen_at));
  EXPECT_FALSE(holds("agv-1", end_));

  says_["agv-1"] = word_;
  says_["agv-1"].held = {{word_.base_in_map, first_}, {{end_.x, end_.y, 0.0}, limit_ - 1}};
  run(0.3);
  EXPECT_TRUE(holds("agv-1", end_));
}

/// The leader is another one now, which never heard agv-1.
TEST_F(SilentOnItsRoad, ANewLeaderHoldsTheRoadOfItsLastWord) {
  word_.held = {{word_.base_in_map, first_}, {{end_.x, end_.y, 0.0}, limit_ - 1}};
  Coordinator next{Coordinator::Settings{}, nullptr};
  next.set_map(clearance_, {0, 0}, {199, 99});
  next.set_vehicle("agv-1", test_support::cart());
  next.sign_off("agv-1", std::nullopt, word_, now_s_);
  next.step(now_s_);
  const auto holders = next.lock().holders("", standing_shape(test_support::cart(), {end_.x, end_.y, 0.0}));
  EXPECT_EQ(holders, std::vector<std::string>{"agv-1"});
}

/// agv-1 has driven some steps and stands at the end of its road; its goal was cancelled. Then its local planner starts
/// again: it counts no steps, and knows the newest plan, which has none.
TEST_F(SilentOnItsRoad, ALocalPlannerThatStartsAgainWithoutRoadTakesPartAgain) {
  coordinator_.set_goal("agv-1", "", std::nullopt, now_s_);
  says_["agv-1"] = word_;
  stand_behind("agv-1", limit_, limit_);
  const Pose2 stands = says_.at("agv-1").base_in_map;
  run(1.0);

  const std::uint64_t cancelled = coordinator_.take_plan_id("agv-1");
  Report restarted;
  restarted.agv_id = "agv-1";
  restarted.base_in_map = stands;
  restarted.boot_id = word_.boot_id + 1;
  says_["agv-1"] = restarted;
  run(3.0);
  says_["agv-1"].plan_id = cancelled;
  run(1.0);
  EXPECT_TRUE(holds("agv-1", stands.position()));

  coordinator_.set_goal("agv-1", "goal-2", Pose2{15.0, 5.0, 0.0}, now_s_);
  run(1.0);
  EXPECT_EQ(ways_.at("agv-1").goal_id, "goal-2");
  EXPECT_GE(ways_.at("agv-1").first_step, limit_) << "numbers of steps are not used again";
  EXPECT_EQ(ways_.at("agv-1").waypoints_in_map.front(), stands.position());
  EXPECT_GT(grants_.at("agv-1").limit_step, limit_);
}

/// The plan with its road may still come to it.
TEST_F(SilentOnItsRoad, ALocalPlannerThatStartsAgainHoldsItsRoadUntilItSaysMore) {
  Report restarted;
  restarted.agv_id = "agv-1";
  restarted.base_in_map = word_.base_in_map;
  restarted.boot_id = word_.boot_id + 1;
  says_["agv-1"] = restarted;
  run(3.0);
  EXPECT_TRUE(holds("agv-1", end_));
}

/// agv-1 has road ahead and says that it is off its path, beside the road that agv-2 will ask for.
class BodyOffItsRoad : public ThingOnTheRoad {
 protected:
  BodyOffItsRoad() {
    says_["agv-1"].base_in_map = beside_;
    says_["agv-1"].stray_m = 1.0;
    says_["agv-1"].speed_mps = 0.0;
  }

  const Pose2 beside_{2.0, 6.0, 0.0};
};

TEST_F(BodyOffItsRoad, IsHeldWhereItIsUntilItIsBack) {
  EXPECT_FALSE(holds("agv-1", beside_.position()));
  run(0.2);
  EXPECT_TRUE(holds("agv-1", beside_.position()));
  EXPECT_TRUE(holds("agv-1", {2.0, 5.0})) << "and its road as well";

  says_["agv-1"].base_in_map = {2.0, 5.0, 0.0};
  says_["agv-1"].stray_m = 0.0;
  run(0.2);
  EXPECT_FALSE(holds("agv-1", beside_.position()));
}

/// 1 m/s, and 2 m/s2 of which 0.7 count: 0.36 m to stop, and 0.3 m until it brakes.
TEST_F(BodyOffItsRoad, IsHeldWithTheWayThatItTakesToStop) {
  run(0.2);
  const double reach_m = 0.35 + 0.1 + 0.35 + 0.1;
  EXPECT_FALSE(holds("agv-1", {2.0, 6.0 + reach_m + 0.1}));
  says_["agv-1"].speed_mps = 1.0;
  run(0.2);
  EXPECT_TRUE(holds("agv-1", {2.0, 6.0 + reach_m + 0.1}));
}

TEST_F(BodyOffItsRoad, HasRoadOfOthersThatMeetsItAskedBack) {
  says_["agv-1"].base_in_map = {2.0, 5.0, 0.0};
  says_["agv-1"].stray_m = 0.0;
  coordinator_.set_goal("agv-2", "goal-2", Pose2{14.0, 2.0, 0.0}, now_s_);
  run(1.0);
  ASSERT_GT(grants_.at("agv-2").limit_step, ways_.at("agv-2").first_step);
  ASSERT_FALSE(grants_.at("agv-2").gives_back);

  const Point2 on_its_road = end_of_step("agv-2", ways_.at("agv-2").first_step);
  says_["agv-1"].base_in_map = {on_its_road.x, on_its_road.y + 0.5, 0.0};
  says_["agv-1"].stray_m = 3.0;
  run(0.2);
  EXPECT_TRUE(grants_.at("agv-2").gives_back);
}

/// It gives its road back, and is planned for from there.
TEST_F(BodyOffItsRoad, IsPlannedForAnewWhenItStandsThere) {
  run(3.0);
  ASSERT_TRUE(grants_.at("agv-1").gives_back);
  Report& says = says_["agv-1"];
  says.grant_number = grants_.at("agv-1").number;
  says.limit_step = says.step_done;
  run(1.5);

  EXPECT_EQ(ways_.at("agv-1").waypoints_in_map.front(), beside_.position());
  EXPECT_EQ(ways_.at("agv-1").waypoints_in_map.back(), (Point2{15.0, 5.0}));
  EXPECT_FALSE(grants_.at("agv-1").gives_back);
}

/// It has done all the steps that it was granted, and stands farther on.
TEST_F(CoordinatorTest, ABodyBeyondItsRoadIsHeldWhereItIs) {
  arrive("agv-1", {2.0, 5.0, 0.0});
  arrive("agv-2", {18.0, 2.0, 0.0});
  run(1.0);
  says_["agv-1"].base_in_map = {3.5, 5.0, 0.0};
  EXPECT_FALSE(holds("agv-1", {3.5, 5.0}));
  run(0.2);
  EXPECT_TRUE(holds("agv-1", {3.5, 5.0}));
}

/// agv-1 is alone and drives a plan without a tube: it may be anywhere beside it. agv-2 arrives.
TEST_F(CoordinatorTest, ANewcomerHasNoRoadUntilTheOtherNamesAPlanWithATube) {
  arrive("agv-1", {2.0, 5.0, 0.0});
  coordinator_.set_goal("agv-1", "goal-1", Pose2{15.0, 5.0, 0.0}, now_s_);
  run(1.0);
  stand_behind("agv-1", ways_.at("agv-1").first_step, grants_.at("agv-1").limit_step);
  ASSERT_EQ(ways_.at("agv-1").tube_m, 0.0);
  run(1.0);

  arrive("agv-2", {18.0, 2.0, 0.0});
  coordinator_.set_goal("agv-2", "goal-2", Pose2{14.0, 2.0, 0.0}, now_s_);
  run(2.0);
  EXPECT_EQ(ways_.at("agv-1").tube_m, 0.10);
  EXPECT_EQ(grants_.at("agv-2").limit_m, 0.0);
  EXPECT_EQ(grants_.at("agv-2").waits_for, std::vector<std::string>{"agv-1"});

  says_["agv-1"].plan_id = ways_.at("agv-1").plan_id;
  says_["agv-1"].grant_number = grants_.at("agv-1").number;
  run(1.0);
  EXPECT_GT(grants_.at("agv-2").limit_m, 0.0);
}

/// Two that begin at either end of an aisle of 2.4 m, with goals at the other end. Own ways keep to its middle.
TEST(Meeting, VehiclesThatMeetOnTheirOwnWaysPassSideBySide) {
  const grid::OccupancyGrid grid(grid::Geometry{240, 24, 0.1, {}});
  const grid::ClearanceField clearance(grid);
  Coordinator coordinator{Coordinator::Settings{}, [](const std::string&, Point2 from, Point2 to) {
                            return std::vector<Point2>{from, to};
                          }};
  coordinator.set_map(clearance, {0, 0}, {239, 23});
  const std::map<std::string, Pose2> starts{{"agv-1", {2.5, 1.2, 0.0}}, {"agv-2", {19.5, 1.2, 3.14}}};
  for (const auto& [id, start] : starts) coordinator.set_vehicle(id, test_support::cart());

  // The goals come one after the other, as messages do, and a step is made after each.
  std::map<std::string, Way> ways;
  const auto step = [&](double now_s) {
    for (const auto& [id, start] : starts) {
      Report report;
      report.agv_id = id;
      report.base_in_map = start;
      coordinator.hear(report, now_s);
    }
    for (const Way& way : coordinator.step(now_s).ways) ways[way.agv_id] = way;
  };
  step(100.0);
  coordinator.set_goal("agv-1", "east", Pose2{22.0, 1.2, 0.0}, 102.0);
  step(102.0);
  coordinator.set_goal("agv-2", "west", Pose2{2.0, 1.2, 0.0}, 102.0);
  for (int i = 0; i <= 10; ++i) step(102.0 + 0.05 * i);

  EXPECT_LT(ways.at("agv-1").step_ends_m.back(), 20.5);
  EXPECT_LT(ways.at("agv-2").step_ends_m.back(), 18.5) << "it does not turn back to let the other pass";
  EXPECT_TRUE(ways.at("agv-2").leads_to_goal);
}

}  // namespace
}  // namespace aisle::global_planner::traffic
