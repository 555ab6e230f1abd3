#include "services/global-planner/core/traffic/joint_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/unit/global-planner/traffic/plan_world.hpp"

namespace aisle::global_planner::traffic {
namespace {

using test_support::Dice;
using test_support::PlanWorld;

const std::vector<std::string> kHall{
    "########################", "#......................#", "#......................#", "#...####....####.......#",
    "#...####....####.......#", "#...####....####.......#", "#......................#", "#......................#",
    "#...####....####.......#", "#...####....####.......#", "#......................#", "#......................#",
    "########################",
};

const std::vector<std::string> kDock{
    "##############################", "#....................#########", "#....................#########",
    "#....................#########", "#....................#########", "#....................#########",
    "#....................#########", "#...........................##", "#...........................##",
    "#....................#########", "#....................#########", "#....................#########",
    "#....................#########", "#....................#########", "##############################",
};

const std::vector<std::string> kLane{
    "########################################", "#.......########################.......#",
    "#.......########################.......#", "#.......########################.......#",
    "#......................................#", "#......................................#",
    "#.......########################.......#", "#.......########################.......#",
    "#.......########################.......#", "########################################",
};

/// Drives until every vehicle has been at its goal, or the time is over.
bool drive_home(PlanWorld& world, double most_s, Dice* dice = nullptr) {
  std::map<std::string, double> held_until_s;
  const auto hold = [&](const std::string& id) {
    if (dice != nullptr && dice->below(200) == 0) held_until_s[id] = world.now_s() + dice->between(2.0, 8.0);
    return held_until_s[id] > world.now_s();
  };

  for (int i = 0; world.now_s() < most_s; ++i) {
    if (i % 2 == 0) world.plan_those_without();
    world.grant();
    world.drive(0.25, hold);

    EXPECT_EQ(world.plan().circles(), 0U);
    EXPECT_EQ(world.refused(), 0U);
    if (world.end_goals_reached() == 0) return true;
  }
  return false;
}

/// A line on who waits for whom, for messages of tests that fail.
std::string who_waits(PlanWorld& world) {
  std::string out;
  for (const auto& [id, agent] : world.plan().agents()) {
    out += id + " at " + std::to_string(agent.place) + " goal " + std::to_string(agent.goal) + " steps " +
           std::to_string(agent.steps.size()) + " (" + agent.reason + ")";
    for (const std::string& other : world.plan().next_waits_for(id)) out += " waits for " + other;
    out += "\n";
  }
  return out;
}

TEST(JointPlan, OneVehicleDrivesToItsGoal) {
  PlanWorld world(kHall);
  world.add("a", world.near({1.5, 1.0}));
  world.send("a", world.near({10.0, 5.0}));

  EXPECT_TRUE(drive_home(world, 60.0)) << who_waits(world);
}

TEST(JointPlan, TwoHeadOnInALanePassOneAfterTheOther) {
  PlanWorld world(kLane);
  world.add("a", world.near({2.0, 2.5}));
  world.add("b", world.near({18.0, 2.5}));
  world.send("a", world.near({18.0, 3.5}));
  world.send("b", world.near({2.0, 3.5}));

  EXPECT_TRUE(drive_home(world, 120.0)) << who_waits(world);
}

TEST(JointPlan, ThreeAgainstThreeInALane) {
  PlanWorld world(kLane);
  const double ys[] = {1.0, 2.4, 3.8};
  for (int i = 0; i < 3; ++i) {
    world.add("a" + std::to_string(i), world.near({1.5, ys[i]}));
    world.add("b" + std::to_string(i), world.near({18.5, ys[i]}));
  }
  for (int i = 0; i < 3; ++i) {
    world.send("a" + std::to_string(i), world.near({18.0, ys[i]}));
    world.send("b" + std::to_string(i), world.near({2.0, ys[i]}));
  }

  EXPECT_TRUE(drive_home(world, 300.0)) << who_waits(world);
}

TEST(JointPlan, AVehicleWithoutGoalLeavesForOneThatMustPass) {
  PlanWorld world(kLane);
  world.add("a", world.near({2.0, 2.5}));
  world.add("idle", world.near({10.0, 2.5}));
  world.send("a", world.near({18.0, 2.5}));

  EXPECT_TRUE(drive_home(world, 120.0)) << who_waits(world);
}

TEST(JointPlan, AGoalWhereAnotherStandsIsFreedByIt) {
  PlanWorld world(kHall);
  const PlaceId goal = world.near({10.0, 5.0});
  world.add("idle", goal);
  world.add("a", world.near({1.5, 1.0}));
  world.send("a", goal);

  EXPECT_TRUE(drive_home(world, 120.0)) << who_waits(world);
}

TEST(JointPlan, NobodyIsPlannedThroughAFrozenVehicle) {
  PlanWorld world(kLane);
  world.add("a", world.near({2.0, 2.5}));
  world.add("dead", world.near({10.0, 2.5}));
  world.send("a", world.near({18.0, 2.5}));
  ASSERT_TRUE(world.plan().plan("a", {}, 0.0));

  const auto cut = world.plan().freeze("dead", 0.0);

  EXPECT_EQ(cut, (std::vector<std::string>{"dead", "a"}));
  EXPECT_FALSE(world.plan().plan("a", {}, 0.0));
  EXPECT_EQ(world.plan().find("a")->waits_for, std::vector<std::string>{"dead"});
  EXPECT_FALSE(world.plan().plan_group("a", 0.0));
}

/// A straight way in pieces of about a metre, as temporary motions.
std::vector<MotionId> straight_way(PlanWorld& world, PlaceId from, PlaceId to) {
  const auto begin = world.roadmap().place(from).base_in_map.position();
  const auto end = world.roadmap().place(to).base_in_map.position();
  const int pieces = static_cast<int>(std::ceil(distance(begin, end)));
  std::vector<MotionId> out;
  PlaceId last = from;
  for (int i = 1; i <= pieces; ++i) {
    const auto at = begin + (static_cast<double>(i) / pieces) * (end - begin);
    const geometry::Pose2 pose{at.x, at.y, bearing(begin, end)};
    const PlaceId next = i == pieces ? to : world.roadmap().temporary_place(world.kind(), pose, false);
    out.push_back(world.roadmap().temporary_motion(
        last, next, {world.roadmap().place(last).base_in_map.position(), pose.position()}));
    last = next;
  }
  return out;
}

TEST(JointPlan, AVehicleDrivesItsOwnWayWhereThatIsNoLater) {
  PlanWorld world(kHall);
  const PlaceId start = world.near({1.0, 1.0});
  const PlaceId goal = world.near({10.5, 0.8});
  world.add("a", start);
  world.send("a", goal);
  const auto own = straight_way(world, start, goal);

  ASSERT_TRUE(world.plan().plan("a", own, 0.0));

  const Agent& agent = *world.plan().find("a");
  ASSERT_EQ(agent.steps.size(), own.size());
  EXPECT_TRUE(agent.steps.front().is_own_way);

  world.grant(2);
  world.plan().cut("a", 0.0);
  ASSERT_TRUE(world.plan().plan("a", {}, 0.0)) << "what is left of the own way is tried again";
  EXPECT_EQ(agent.steps.size(), own.size());
  EXPECT_TRUE(agent.steps.back().is_own_way);

  world.roadmap().sweep(world.plan().places_in_use(), world.plan().motions_in_use());
  EXPECT_TRUE(drive_home(world, 60.0)) << who_waits(world);
}

TEST(JointPlan, ATemporaryMotionHoldsTheFloorOfThePlacesAtItsEnds) {
  PlanWorld world(kHall);
  const PlaceId from = world.near({1.0, 1.0});
  const PlaceId to = world.near({1.0, 3.0});
  const geometry::Point2 begin = world.roadmap().place(from).base_in_map.position();
  const geometry::Point2 near_end = world.roadmap().place(to).base_in_map.position() + geometry::Point2{0.008, 0.0};

  const Motion& motion = world.roadmap().motion(world.roadmap().temporary_motion(from, to, {begin, near_end}));

  EXPECT_EQ(motion.path_in_map.front(), begin);
  EXPECT_EQ(motion.path_in_map.back(), world.roadmap().place(to).base_in_map.position());
}

TEST(JointPlan, WhatASweepEndedIsForgotten) {
  PlanWorld world(kHall);
  const PlaceId start = world.near({1.0, 1.0});
  const PlaceId goal = world.near({10.5, 0.8});
  const auto places = world.places();
  world.add("a", start);
  for (std::size_t i = 0; i < 300; ++i) {
    const PlaceId other = places[i % places.size()];
    if (other == start) continue;
    world.send("a", other);
    ASSERT_TRUE(world.plan().plan("a", straight_way(world, start, other), 0.0));
    world.plan().cut("a", 0.0);
    world.plan().find("a")->goal = kNoId;
    world.plan().plan("a", {}, 0.0);
    world.plan().retime(0.0);
    world.plan().forget(world.roadmap().sweep(world.plan().places_in_use(), world.plan().motions_in_use()));
  }
  world.send("a", goal);
  EXPECT_TRUE(drive_home(world, 60.0)) << who_waits(world);
  EXPECT_EQ(world.refused(), 0U);
}

const std::vector<std::string> kLaneWithBay{
    "##############################", "#############....#############", "#############....#############",
    "#############....#############", "#############....#############", "#............................#",
    "#............................#", "##############################",
};

TEST(JointPlan, TwoSwapInALaneByTheBay) {
  PlanWorld world(kLaneWithBay);
  world.add("a", world.near({1.0, 1.0}));
  world.add("b", world.near({14.0, 1.0}));
  world.send("a", world.near({14.0, 1.0}));
  world.send("b", world.near({1.0, 1.0}));

  EXPECT_TRUE(drive_home(world, 200.0)) << who_waits(world);
}

TEST(JointPlan, TheLastResortBringsTheOldestToItsGoal) {
  PlanWorld world(kLaneWithBay);
  world.add("a", world.near({4.0, 1.0}));
  world.add("b", world.near({8.0, 1.0}));
  world.add("c", world.near({12.0, 1.0}));
  world.send("a", world.near({14.0, 1.0}));
  world.send("c", world.near({1.0, 1.0}));

  ASSERT_TRUE(world.plan().plan_all(0.0));

  EXPECT_TRUE(world.plan().find("a")->has_plan_to_goal);
  EXPECT_TRUE(world.has_no_circle());
  EXPECT_TRUE(drive_home(world, 200.0)) << who_waits(world);
}

TEST(JointPlan, TheLastResortChangesNothingWhereThereIsNoWay) {
  PlanWorld world({"####################", "#..................#", "#..................#", "####################"});
  world.add("a", world.near({1.0, 1.0}));
  world.add("b", world.near({5.0, 1.0}));
  world.send("a", world.near({9.0, 1.0}));
  world.send("b", world.near({2.0, 1.0}));

  EXPECT_FALSE(world.plan().plan_all(0.0));
  EXPECT_TRUE(world.plan().find("a")->steps.empty());
  EXPECT_TRUE(world.plan().find("b")->steps.empty());
}

/// Pairs of steps of all plans that one open motion could replace, and places that a plan comes back to.
int detours(PlanWorld& world) {
  int count = 0;
  for (const auto& [id, agent] : world.plan().agents()) {
    for (std::size_t i = agent.pending(); i + 1 < agent.steps.size(); ++i) {
      const PlaceId here = world.roadmap().motion(agent.steps[i].motion).from;
      const PlaceId there = world.roadmap().motion(agent.steps[i + 1].motion).to;
      const auto& leaving = world.roadmap().place(here).leaving;
      const bool is_direct = std::any_of(leaving.begin(), leaving.end(),
                                         [&](MotionId motion) { return world.roadmap().motion(motion).to == there; });
      if (here == there || is_direct) ++count;
    }
  }
  return count;
}

/// A vehicle that has to wait for the other waits where it is: it does not drive to and fro meanwhile. By each of these
/// seeds driving brings it a moment sooner to its goal.
TEST(JointPlan, AVehicleThatWaitsDrivesNoDetours) {
  for (const std::uint64_t seed : {52, 113, 184, 325, 399, 432, 467}) {
    PlanWorld world(kDock);
    Dice dice(seed);
    const auto somewhere = [&] {
      const auto places = world.places();
      const auto at = world.roadmap().place(places[dice.below(places.size())]).base_in_map.position();
      return world.roadmap().temporary_place(
          world.kind(), {at.x + dice.between(-0.2, 0.2), at.y + dice.between(-0.2, 0.2), dice.between(-3.0, 3.0)});
    };
    for (int i = 1; i <= 2; ++i) {
      const std::string id = "agv-" + std::to_string(i);
      const PlaceId start = somewhere(), goal = somewhere();
      world.add(id, start).heading_rad = world.roadmap().place(start).base_in_map.yaw;
      world.send(id, goal);
    }
    world.plan_those_without();
    EXPECT_EQ(detours(world), 0) << "seed " << seed;
  }
}

TEST(JointPlan, TheSameCallsGiveTheSamePlans) {
  std::vector<double> ends[2];
  for (auto& out : ends) {
    PlanWorld world(kHall);
    Dice dice(5);
    const auto places = world.places();
    for (int i = 0; i < 6; ++i) world.add("v" + std::to_string(i), places[static_cast<std::size_t>(i) * 7]);
    for (int i = 0; i < 6; ++i) world.send("v" + std::to_string(i), places[dice.below(places.size())]);
    world.plan_those_without();
    for (const auto& [id, agent] : world.plan().agents())
      for (const Step& step : agent.steps) out.push_back(step.end_s);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

/// Places of which no two are nearer than 1.2 m.
std::vector<PlaceId> apart(PlanWorld& world, std::size_t count, Dice& dice) {
  std::vector<PlaceId> out;
  const auto places = world.places();
  for (int tries = 0; out.size() < count && tries < 10'000; ++tries) {
    const PlaceId place = places[dice.below(places.size())];
    const auto here = world.roadmap().place(place).base_in_map.position();
    const bool is_apart = std::all_of(out.begin(), out.end(), [&](PlaceId other) {
      return distance(here, world.roadmap().place(other).base_in_map.position()) >= 1.2;
    });
    if (is_apart) out.push_back(place);
  }
  return out;
}

class RandomPlans : public ::testing::TestWithParam<int> {};

TEST_P(RandomPlans, PlansCutsAndRetimingsLeadInNoCircle) {
  PlanWorld world(kHall);
  Dice dice(static_cast<std::uint64_t>(GetParam()) + 1);
  const auto starts = apart(world, 8, dice);
  const auto places = world.places();
  for (std::size_t i = 0; i < starts.size(); ++i) world.add("v" + std::to_string(i), starts[i]);

  for (int turn = 0; turn < 300; ++turn) {
    const std::string id = "v" + std::to_string(dice.below(starts.size()));
    switch (dice.below(8)) {
      case 0:
        world.send(id, places[dice.below(places.size())]);
        break;
      case 1:
        world.plan().cut(id, world.now_s());
        break;
      case 2:
        world.plan().plan_group(id, world.now_s());
        break;
      case 3:
        world.plan_those_without();
        break;
      default:
        world.end_goals_reached();
        world.plan().plan(id, {}, world.now_s());
    }
    ASSERT_TRUE(world.has_no_circle()) << "turn " << turn;
    world.grant(2);
    world.drive(0.25, [&](const std::string&) { return dice.below(4) == 0; });
    ASSERT_TRUE(world.has_no_circle()) << "turn " << turn;
    ASSERT_EQ(world.plan().circles(), 0U) << "turn " << turn;
    ASSERT_EQ(world.refused(), 0U) << "turn " << turn;
  }
}

TEST_P(RandomPlans, EverybodyComesHome) {
  PlanWorld world(kHall);
  Dice dice(static_cast<std::uint64_t>(GetParam()) + 100);
  const auto starts = apart(world, 8, dice);
  const auto goals = apart(world, 8, dice);
  ASSERT_EQ(starts.size(), 8U);
  ASSERT_EQ(goals.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) world.add("v" + std::to_string(i), starts[i]);
  for (std::size_t i = 0; i < 8; ++i) world.send("v" + std::to_string(i), goals[i]);

  EXPECT_TRUE(drive_home(world, 300.0, &dice)) << who_waits(world);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPlans, ::testing::Range(0, 10));

}  // namespace
}  // namespace aisle::global_planner::traffic
