// The fleet's decisions, with invented times.
#include "services/global-planner/core/fleet_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kRadius_m = 0.3;
const Pose2 kStart{1.0, 5.0, 0.0};
const Pose2 kGoal{19.0, 5.0, 0.0};

/// A hall of 20 x 10 m at 0.1 m a cell with two doors in a wall at x = 10: a straight one at y = 5, one around at y
/// = 9.
class Fleet : public testing::Test {
 protected:
  Fleet() : grid_(grid::Geometry{200, 100, 0.1, {}}), planner_(FleetSettings{}, find_variant("direct")->make()) {
    block(10.0, 0.0, 10.2, 10.0);
    block(10.0, 4.0, 10.2, 6.0, grid::Occupancy::kFree);
    block(10.0, 8.0, 10.2, 9.8, grid::Occupancy::kFree);
    publish_map();
  }

  void block(double x0, double y0, double x1, double y1, grid::Occupancy fill = grid::Occupancy::kOccupied) {
    const grid::Cell low = grid_.geometry().cell_at({x0 + 1e-6, y0 + 1e-6});
    const grid::Cell high = grid_.geometry().cell_at({x1 - 1e-6, y1 - 1e-6});
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) grid_.set({x, y}, fill);
    }
  }
  void publish_map() { planner_.set_map("site", ++revision_, grid_, {0, 0}, {199, 99}); }

  void arrive(const std::string& id, const Pose2& pose) {
    planner_.set_vehicle(id, kRadius_m);
    planner_.set_pose(id, pose, now_);
    poses_[id] = pose;
  }
  /// Time goes on; every vehicle says again where it is.
  void wait(double seconds) {
    for (double left = seconds; left > 1e-9; left -= 0.1) {
      now_ += time::from_seconds(0.1);
      for (const auto& [id, pose] : poses_) planner_.set_pose(id, pose, now_);
    }
  }
  void move(const std::string& id, const Pose2& pose) {
    poses_[id] = pose;
    wait(0.1);
  }
  std::optional<Plan> step() { return planner_.step(now_, nullptr); }
  /// Plans that come out while time goes on.
  std::vector<Plan> plans_within(double seconds) {
    std::vector<Plan> plans;
    for (double left = seconds; left > 1e-9; left -= 0.1) {
      wait(0.1);
      while (auto plan = step()) plans.push_back(*plan);
    }
    return plans;
  }
  Plan first_plan(const Goal& goal = {"agv-1", "goal-1", kGoal, 0.1, 0.0, false}) {
    planner_.set_goal(goal);
    const auto plan = step();
    EXPECT_TRUE(plan.has_value());
    return plan.value_or(Plan{});
  }
  bool is_drivable_now(const Plan& plan) const {
    const grid::ClearanceField clearance(grid_, 2.0);
    return is_drivable(
        {clearance, plan.waypoints_in_map.front(), plan.waypoints_in_map.back(), kRadius_m, kRadius_m - 0.1},
        plan.waypoints_in_map);
  }
  static double distance_to(const Plan& plan, Point2 p) {
    double least_m = 1e9;
    for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
      least_m =
          std::min(least_m, geometry::distance_to_segment(p, plan.waypoints_in_map[i - 1], plan.waypoints_in_map[i]));
    }
    return least_m;
  }

  grid::OccupancyGrid grid_;
  FleetPlanner planner_;
  std::uint64_t revision_{0};
  time::Stamp now_{time::from_seconds(100.0)};
  std::map<std::string, Pose2> poses_;
};

TEST_F(Fleet, PlansForANewGoalOnce) {
  arrive("agv-1", kStart);
  const Plan plan = first_plan();
  EXPECT_EQ(plan.outcome, PlanOutcome::kFound);
  EXPECT_EQ(plan.trigger, PlanTrigger::kNewGoal);
  EXPECT_EQ(plan.agv_id, "agv-1");
  EXPECT_EQ(plan.goal_id, "goal-1");
  EXPECT_EQ(plan.map_id, "site");
  EXPECT_EQ(plan.map_revision, 1U);
  EXPECT_TRUE(is_drivable_now(plan));
  EXPECT_EQ(plan.waypoints_in_map.front(), kStart.position());
  EXPECT_EQ(plan.waypoints_in_map.back(), kGoal.position());
  EXPECT_TRUE(plans_within(20.0).empty());
}

TEST_F(Fleet, WaitsForMapVehicleAndState) {
  FleetPlanner fresh(FleetSettings{}, find_variant("direct")->make());
  fresh.set_goal({"agv-1", "goal-1", kGoal, 0.1, 0.0, false});
  EXPECT_FALSE(fresh.step(now_, nullptr));
  EXPECT_EQ(fresh.waits_for(now_), "map_info and map_tile, vehicle_info of agv-1, vehicle_state of agv-1");
  fresh.set_map("site", 1, grid_, {0, 0}, {199, 99});
  fresh.set_vehicle("agv-1", kRadius_m);
  EXPECT_FALSE(fresh.step(now_, nullptr));
  EXPECT_EQ(fresh.waits_for(now_), "vehicle_state of agv-1");
  fresh.set_pose("agv-1", kStart, now_);
  EXPECT_EQ(fresh.waits_for(now_), "");
  EXPECT_TRUE(fresh.step(now_, nullptr));
}

TEST_F(Fleet, DoesNotPlanFromAPoseLongGone) {
  arrive("agv-1", kStart);
  now_ += time::from_seconds(5.0);
  planner_.set_goal({"agv-1", "goal-1", kGoal, 0.1, 0.0, false});
  EXPECT_FALSE(step());
}

TEST_F(Fleet, KeepsAPlanThatAnEditDoesNotBlock) {
  arrive("agv-1", kStart);
  const Plan before = first_plan();
  block(2.0, 1.0, 3.0, 2.0);
  publish_map();
  const auto after = step();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->id, before.id);
  EXPECT_EQ(after->waypoints_in_map, before.waypoints_in_map);
  EXPECT_EQ(after->map_revision, 2U);
  EXPECT_FALSE(step());
}

TEST_F(Fleet, ReplacesAPlanThatAnEditBlocks) {
  arrive("agv-1", kStart);
  const Plan before = first_plan();
  block(10.0, 4.0, 10.2, 6.0);
  publish_map();
  const auto after = step();
  ASSERT_TRUE(after);
  EXPECT_NE(after->id, before.id);
  EXPECT_EQ(after->trigger, PlanTrigger::kMapChanged);
  EXPECT_EQ(after->outcome, PlanOutcome::kFound);
  EXPECT_EQ(after->map_revision, 2U);
  EXPECT_TRUE(is_drivable_now(*after));
  EXPECT_GT(after->length_m, before.length_m + 1.0);
}

TEST_F(Fleet, DoesNotMindAnEditBehindTheVehicle) {
  arrive("agv-1", kStart);
  const Plan before = first_plan();
  for (double x = 1.0; x <= 14.0; x += 0.5) {
    move("agv-1", {x, 5.0, 0.0});
    EXPECT_FALSE(step());
  }
  block(10.0, 4.0, 10.2, 6.0);
  publish_map();
  const auto after = step();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->id, before.id);
}

TEST_F(Fleet, KeepsAPlanThroughManyEditsElsewhereWhileItIsDriven) {
  for (int i = 0; i < 12; ++i) block(2.0 + 0.6 * i, 0.5 + (i * 7) % 8, 2.3 + 0.6 * i, 1.6 + (i * 7) % 8);
  publish_map();
  arrive("agv-1", {0.6, 0.6, 0.0});
  const Plan plan = first_plan({"agv-1", "goal-1", {19.3, 9.3, 0.0}, 0.1, 0.0, false});
  ASSERT_GT(plan.waypoints_in_map.size(), 3U);
  for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
    const Point2 from = plan.waypoints_in_map[i - 1];
    const Point2 to = plan.waypoints_in_map[i];
    const int pieces = 1 + static_cast<int>(geometry::distance(from, to) / 0.07);
    for (int k = 0; k < pieces; ++k) {
      const Point2 p = from + (static_cast<double>(k) / pieces) * (to - from);
      move("agv-1", {p.x, p.y + 0.03, 0.0});
      publish_map();
      const auto checked = step();
      ASSERT_TRUE(checked);
      ASSERT_EQ(checked->id, plan.id) << "at " << p.x << ", " << p.y;
    }
  }
}

TEST_F(Fleet, DoesNotGoBackWhenAShorterWayOpens) {
  arrive("agv-1", kStart);
  block(10.0, 4.0, 10.2, 6.0);
  publish_map();
  const Plan before = first_plan();
  block(10.0, 4.0, 10.2, 6.0, grid::Occupancy::kFree);
  publish_map();
  const auto after = step();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->id, before.id);
}

TEST_F(Fleet, SaysThatThereIsNoPathAndFindsOneWhenTheMapOpens) {
  arrive("agv-1", kStart);
  first_plan();
  block(10.0, 0.0, 10.2, 10.0);
  publish_map();
  const auto none = step();
  ASSERT_TRUE(none);
  EXPECT_EQ(none->outcome, PlanOutcome::kNoPath);
  EXPECT_TRUE(none->waypoints_in_map.empty());
  EXPECT_NE(none->detail.find("no way from (1.00, 5.00) to (19.00, 5.00)"), std::string::npos) << none->detail;
  EXPECT_NE(none->detail.find("nearest reachable point is (9."), std::string::npos) << none->detail;
  EXPECT_TRUE(plans_within(30.0).empty()) << "says the same again";
  block(10.0, 4.0, 10.2, 6.0, grid::Occupancy::kFree);
  publish_map();
  const auto found = step();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->outcome, PlanOutcome::kFound);
}

TEST_F(Fleet, NamesWhatIsWrongWithAGoal) {
  arrive("agv-1", kStart);
  const Plan wall = first_plan({"agv-1", "a", {10.1, 2.0, 0.0}, 0.1, 0.0, false});
  EXPECT_EQ(wall.outcome, PlanOutcome::kGoalBlocked);
  EXPECT_NE(wall.detail.find("the goal (10.10, 2.00) has 0.00 m of clearance"), std::string::npos) << wall.detail;
  EXPECT_NE(wall.detail.find("m from the goal"), std::string::npos) << wall.detail;
  const Plan outside = first_plan({"agv-1", "b", {30.0, 2.0, 0.0}, 0.1, 0.0, false});
  EXPECT_EQ(outside.outcome, PlanOutcome::kOutOfMap);
  EXPECT_NE(outside.detail.find("the goal (30.00, 2.00) is outside the map, x 0.00 to 20.00, y 0.00 to 10.00"),
            std::string::npos)
      << outside.detail;
  planner_.set_goal({"agv-1", "c", kGoal, 0.1, 0.0, false});
  const auto late = planner_.step(now_, [] { return true; });
  ASSERT_TRUE(late);
  EXPECT_EQ(late->outcome, PlanOutcome::kOutOfTime);
  arrive("agv-2", {10.1, 2.0, 0.0});
  const Plan inside = first_plan({"agv-2", "goal-1", kGoal, 0.1, 0.0, false});
  EXPECT_EQ(inside.outcome, PlanOutcome::kStartBlocked);
  EXPECT_NE(inside.detail.find("the vehicle at (10.10, 2.00)"), std::string::npos) << inside.detail;
}

TEST_F(Fleet, TriesAgainWhenTimeRanOut) {
  arrive("agv-1", kStart);
  planner_.set_goal({"agv-1", "goal-1", kGoal, 0.1, 0.0, false});
  ASSERT_EQ(planner_.step(now_, [] { return true; })->outcome, PlanOutcome::kOutOfTime);
  EXPECT_FALSE(step());
  const std::vector<Plan> plans = plans_within(5.0);
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].outcome, PlanOutcome::kFound);
}

TEST_F(Fleet, CancelsOnceAndPlansAgainForTheNextGoal) {
  arrive("agv-1", kStart);
  first_plan();
  const Plan cancelled = first_plan({"agv-1", "goal-1", kGoal, 0.1, 0.0, true});
  EXPECT_EQ(cancelled.outcome, PlanOutcome::kCancelled);
  EXPECT_EQ(cancelled.goal_id, "goal-1");
  EXPECT_TRUE(cancelled.waypoints_in_map.empty());
  EXPECT_TRUE(plans_within(10.0).empty());
  EXPECT_EQ(first_plan({"agv-1", "goal-2", kGoal, 0.1, 0.0, false}).outcome, PlanOutcome::kFound);
}

TEST_F(Fleet, SkipsAGoalThatWasReachedBeforeItStarted) {
  arrive("agv-1", kGoal);
  NavigationStatus arrived;
  arrived.agv_id = "agv-1";
  arrived.goal_id = "goal-1";
  arrived.plan_id = 4;
  arrived.phase = Phase::kArrived;
  planner_.set_navigation(arrived);
  planner_.set_goal({"agv-1", "goal-1", kGoal, 0.1, 0.0, false});
  EXPECT_TRUE(plans_within(5.0).empty());
  planner_.set_goal({"agv-1", "goal-2", kStart, 0.1, 0.0, false});
  EXPECT_TRUE(step());
}

TEST_F(Fleet, TakesAnOwnWayAroundWhatStandsThereWhereThereIsOne) {
  arrive("agv-1", kStart);
  first_plan();
  const auto way_around = [&](const Disc& disc) {
    Plan plan;
    plan.waypoints_in_map = planner_.own_way("agv-1", kStart.position(), kGoal.position(), {disc}, nullptr);
    return plan;
  };

  const Plan beside = way_around({{6.0, 5.0}, 0.4});
  ASSERT_GT(beside.waypoints_in_map.size(), 2U);
  EXPECT_GE(distance_to(beside, {6.0, 5.0}), 0.4 + kRadius_m);
  EXPECT_TRUE(is_drivable_now(beside));

  const Plan other_door = way_around({{10.1, 5.0}, 0.9});
  EXPECT_GT(distance_to(other_door, {10.1, 5.0}), 2.0);
  EXPECT_FALSE(way_around({{19.0, 5.0}, 0.4}).waypoints_in_map.empty()) << "what stands on the goal is the traffic's";
  EXPECT_TRUE(planner_.own_way("agv-9", kStart.position(), kGoal.position(), {}, nullptr).empty());
}

TEST_F(Fleet, PlansAnewAfterATakeover) {
  arrive("agv-1", kStart);
  const Plan before = first_plan();
  planner_.take_over();
  const auto after = step();
  ASSERT_TRUE(after);
  EXPECT_EQ(after->trigger, PlanTrigger::kTakeover);
  EXPECT_EQ(after->waypoints_in_map, before.waypoints_in_map);
  EXPECT_FALSE(step());
}

TEST_F(Fleet, AGoalThatAnotherLeaderPlannedForIsTakenOverThoughItComesLate) {
  planner_.hear_plan("agv-1", "goal-1");
  planner_.take_over();
  arrive("agv-1", kStart);
  EXPECT_EQ(first_plan().trigger, PlanTrigger::kTakeover);
}

TEST_F(Fleet, AsPrintedASteeredVehicleGetsThePathOfTheChosenPlanner) {
  const auto plan_of = [&](bool as_printed) {
    FleetSettings settings;
    settings.as_printed = as_printed;
    planner_ = FleetPlanner(settings, find_variant("astar")->make());
    publish_map();
    planner_.set_vehicle("agv-1", VehicleShape{kRadius_m, kRadius_m, 1.0, {0.0}});
    planner_.set_pose("agv-1", {1.0, 5.0, 2.0}, now_);
    return first_plan();
  };
  const Plan printed = plan_of(true);
  const Point2 leg = printed.waypoints_in_map.at(1) - printed.waypoints_in_map.at(0);
  EXPECT_LT(std::abs(std::atan2(leg.y, leg.x)), 0.5) << "towards the door, whatever the heading";
  EXPECT_GT(plan_of(false).length_m, printed.length_m + 0.3) << "turns about first";
}

TEST_F(Fleet, ServesEveryVehicleInTurn) {
  for (int i = 0; i < 5; ++i) {
    const std::string id = "agv-" + std::to_string(i);
    arrive(id, {1.0, 1.0 + 1.5 * i, 0.0});
    planner_.set_goal({id, "goal", {17.0, 1.0 + 1.5 * i, 0.0}, 0.1, 0.0, false});
  }
  std::map<std::string, int> served;
  while (const auto plan = step()) ++served[plan->agv_id];
  EXPECT_EQ(served.size(), 5U);
  for (const auto& [id, count] : served) EXPECT_EQ(count, 1) << id;
}

/// A planner of its own settings for agv-1, with everything that it needs to plan.
std::unique_ptr<FleetPlanner> planner_for_goal(const FleetSettings& settings, const std::string& name,
                                               const grid::OccupancyGrid& grid, time::Stamp now) {
  auto planner = std::make_unique<FleetPlanner>(settings, find_variant(name)->make());
  planner->set_map("site", 1, grid, {0, 0}, {grid.geometry().width - 1, grid.geometry().height - 1});
  planner->set_vehicle("agv-1", kRadius_m);
  planner->set_pose("agv-1", kStart, now);
  planner->set_goal({"agv-1", "goal-1", kGoal, 0.1, 0.0, false});
  return planner;
}

TEST_F(Fleet, GoesToTheNearestPointOnlyWhenAskedTo) {
  block(10.0, 0.0, 10.2, 10.0);  // no door
  const Plan refused = *planner_for_goal(FleetSettings{}, "direct", grid_, now_)->step(now_, nullptr);
  EXPECT_EQ(refused.outcome, PlanOutcome::kNoPath);
  EXPECT_TRUE(refused.waypoints_in_map.empty());

  FleetSettings settings;
  settings.to_nearest = true;
  const auto planner = planner_for_goal(settings, "direct", grid_, now_);
  const Plan plan = *planner->step(now_, nullptr);
  EXPECT_EQ(plan.outcome, PlanOutcome::kFound);
  EXPECT_EQ(plan.goal_in_map.position(), plan.waypoints_in_map.back());
  EXPECT_NE(plan.goal_in_map.x, kGoal.x) << "the goal cannot be reached";
  EXPECT_FALSE(planner->step(now_, nullptr)) << "the plan is one for that goal";
  EXPECT_TRUE(is_drivable_now(plan));
  EXPECT_NEAR(plan.waypoints_in_map.back().x, 10.0 - kRadius_m - 0.1, 0.1);
  EXPECT_NE(plan.detail.find("the nearest reachable point is"), std::string::npos) << plan.detail;
  EXPECT_FALSE(planner->step(now_, nullptr));

  block(10.0, 4.0, 10.2, 6.0, grid::Occupancy::kFree);
  planner->set_map("site", 2, grid_, {100, 40}, {101, 59});
  const Plan there = *planner->step(now_, nullptr);
  EXPECT_EQ(there.goal_in_map.x, kGoal.x);
  EXPECT_EQ(there.waypoints_in_map.back(), kGoal.position());
}

TEST_F(Fleet, PrefersClearanceAsFarAsItsSettingsSay) {
  block(3.0, 0.0, 8.0, 4.4);  // a rack beside the straight way
  const auto from_rack_m = [&](double preferred_clearance_m) {
    FleetSettings settings;
    settings.preferred_clearance_m = preferred_clearance_m;
    const Plan plan = *planner_for_goal(settings, "clear", grid_, now_)->step(now_, nullptr);
    EXPECT_TRUE(is_drivable_now(plan));
    return std::min(distance_to(plan, {3.0, 4.4}), distance_to(plan, {8.0, 4.4}));
  };
  EXPECT_NEAR(from_rack_m(0.45), 0.6, 0.1);
  EXPECT_GT(from_rack_m(1.5), 0.9);
}

// QU 2.3.2: a node goes where the line past it keeps "a predetermined safe distance".
TEST_F(Fleet, KeepsTheSafeDistanceOfQuBesideTheLinesItDraws) {
  block(3.0, 0.0, 8.0, 5.6);  // a rack on the straight way
  const auto waypoints = [&](double safe_distance_m) {
    FleetSettings settings;
    settings.safe_distance_m = safe_distance_m;
    const Plan plan = *planner_for_goal(settings, "qu", grid_, now_)->step(now_, nullptr);
    EXPECT_TRUE(is_drivable_now(plan));
    return plan.waypoints_in_map.size();
  };
  EXPECT_EQ(FleetSettings{}.safe_distance_m, 0.3);
  EXPECT_GT(waypoints(0.3), waypoints(0.0)) << "a line that would pass nearer is not drawn";
}

}  // namespace
}  // namespace aisle::global_planner
