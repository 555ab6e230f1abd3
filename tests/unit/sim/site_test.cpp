// A whole site in virtual time: all services, the referee, and faults.
#include "tools/sim/site.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tools/sim/scenarios/building.hpp"

namespace aisle::sim {
namespace {

using ::testing::HasSubstr;

/// Two vehicles that pass each other in a hall, and a person who walks to and fro.
sim::Setup hall_with_two_vehicles(std::uint64_t seed) {
  sim::Setup setup;
  setup.grid = sim::hall(16.0, 8.0, 0.1);
  setup.scenario.name = "hall";
  setup.scenario.duration_s = 90.0;
  setup.scenario.start_jitter_m = 0.1;
  sim::add_vehicle(setup, 1, {2.0, 3.0, 0.0}, {{13.0, 3.0, 0.0}});
  sim::add_vehicle(setup, 2, {14.0, 5.0, 3.1}, {{3.0, 5.0, 0.0}});
  sim::add_mover(setup, 1.0, 0.0, true, {{8.0, 1.0}, {8.0, 7.0}});
  setup.seed = seed;
  return setup;
}

Faults faults_of(const FaultPlan& plan) { return {plan, 7}; }

template <class T>
T once(double at_s, const std::string& process) {
  T occasion;
  occasion.at_s = at_s;
  occasion.process = process;
  return occasion;
}

void expect_a_good_run(const Outcome& outcome) {
  EXPECT_EQ(outcome.result.goals_reached, 2);
  EXPECT_EQ(outcome.report.contacts_moving_vehicle(), 0);
  EXPECT_TRUE(outcome.report.violations.empty());
  EXPECT_EQ(outcome.report.ended_because, "all missions are over");
}

TEST(Site, TheSameSeedDrivesTheSameTraceAndAnotherAnother) {
  const Outcome one = drive(hall_with_two_vehicles(1));
  const Outcome again = drive(hall_with_two_vehicles(1));
  const Outcome other = drive(hall_with_two_vehicles(2));
  expect_a_good_run(one);
  EXPECT_TRUE(one.report.passed());
  EXPECT_TRUE(one.faults.empty());
  EXPECT_EQ(one.result.trace_hash, again.result.trace_hash);
  EXPECT_EQ(one.messages, again.messages);
  EXPECT_NE(one.result.trace_hash, other.result.trace_hash);
}

TEST(Site, AStandInMayTellTheTruthInTheTrackersPlace) {
  sim::Setup setup = hall_with_two_vehicles(1);
  setup.perception = sim::Perception::kTruth;
  const Outcome outcome = drive(setup);
  expect_a_good_run(outcome);
  EXPECT_GT(outcome.result.distance_m, 18.0);
  EXPECT_GT(outcome.result.planned_m, 18.0);
  EXPECT_GT(outcome.result.jerk_samples, 1000u);
}

TEST(Site, DrivesAVariantThatHasNoName) {
  sim::Setup setup = hall_with_two_vehicles(1);
  const Outcome named = drive(setup);
  setup.own_variant = *local_planner::find_variant(setup.local);
  EXPECT_EQ(drive(setup).result.trace_hash, named.result.trace_hash) << "the same variant, handed over";

  // Alone on the floor, where it is not kept to its way.
  setup.scenario.vehicles.resize(1);
  setup.scenario.missions.resize(1);
  const std::uint64_t alone = drive(setup).result.trace_hash;
  setup.own_variant->knows_path = false;
  const Outcome own = drive(setup);
  EXPECT_EQ(own.result.goals_reached, 1);
  EXPECT_EQ(own.report.contacts_moving_vehicle(), 0);
  EXPECT_NE(own.result.trace_hash, alone);
}

TEST(Site, WithTracksHeldStillItDrivesWithoutPrediction) {
  sim::Setup setup = hall_with_two_vehicles(1);
  const Outcome predicted = drive(setup);
  setup.perception = sim::Perception::kScansHeldStill;
  const Outcome held_still = drive(setup);
  EXPECT_EQ(held_still.result.goals_reached, 2);
  EXPECT_NE(held_still.result.trace_hash, predicted.result.trace_hash);
}

TEST(Site, IsSeenTenTimesASecondAndDrivesTheSame) {
  std::vector<double> times_s;
  double nearest_m = 1e9;
  bool had_plans = false, saw_a_track_move = false, was_faster = false;
  Hooks hooks;
  hooks.watch = [&](const Snapshot& now) {
    times_s.push_back(now.t_s);
    ASSERT_EQ(now.vehicles_in_map.size(), 2U);
    ASSERT_EQ(now.outputs.size(), 2U);
    nearest_m = std::min(nearest_m, geometry::distance(now.vehicles_in_map[0].position(), {13.0, 3.0}));
    had_plans = had_plans || (now.plans.at(0) != nullptr && now.plans.at(0)->agv_id == "agv-1");
    was_faster = was_faster || now.outputs[0].twist.linear_mps > 0.5;
    for (const fleet::Track& track : now.tracks)
      saw_a_track_move = saw_a_track_move || geometry::norm(track.velocity_in_map) > 0.5;
    ASSERT_LE(now.things.size(), 1U);
  };
  const Outcome watched = drive(hall_with_two_vehicles(1), {}, hooks);
  EXPECT_EQ(watched.result.trace_hash, drive(hall_with_two_vehicles(1)).result.trace_hash);
  ASSERT_GT(times_s.size(), 50U);
  EXPECT_LT(times_s.front(), 1.0);
  for (std::size_t i = 1; i < times_s.size(); ++i) EXPECT_NEAR(times_s[i] - times_s[i - 1], 0.1, 1e-9);
  EXPECT_LT(nearest_m, 0.3);
  EXPECT_TRUE(had_plans && saw_a_track_move && was_faster);
}

TEST(Site, RecordedPeopleAreThoseOfTheSetup) {
  sim::Setup setup = hall_with_two_vehicles(1);
  setup.scenario.recordings.emplace_back();  // of no file: it is read already
  setup.people = {{fake_world::RecordedPerson("passer-by", {{0.0, {1.0, 7.0}}, {20.0, {15.0, 7.0}}})}};
  double farthest_m = 0.0;
  Hooks hooks;
  hooks.goes_on = [](double t_s) { return t_s < 5.0; };
  hooks.watch = [&](const Snapshot& now) {
    for (const geometry::Body& thing : now.things)
      if (std::abs(thing.base_in_map.y - 7.0) < 0.01) farthest_m = std::max(farthest_m, thing.base_in_map.x);
  };
  drive(setup, {}, hooks);
  EXPECT_NEAR(farthest_m, 1.0 + 14.0 / 20.0 * 4.4, 0.7);
}

TEST(Site, TimeOfDrivingCountsFromTheFirstGoal) {
  const Result all_reached = drive(hall_with_two_vehicles(1)).result;
  EXPECT_GT(all_reached.first_goal_s, 0.0);
  EXPECT_LT(all_reached.first_goal_s, 1.0) << "people move from the start, so goals must come at once";
  const double last_s = *std::max_element(all_reached.done_s.begin(), all_reached.done_s.end());
  EXPECT_NEAR(all_reached.driven_s, last_s - all_reached.first_goal_s, 1e-9);

  const Result stopped = drive(hall_with_two_vehicles(1), {}, {[](double t_s) { return t_s < 3.0; }}).result;
  EXPECT_NEAR(stopped.driven_s, stopped.time_s - stopped.first_goal_s, 1e-9);
}

TEST(Site, TellsHowMuchVehiclesWaitedAndOnWhoseWayTheyDrove) {
  const Result result = drive(hall_with_two_vehicles(1)).result;
  EXPECT_NEAR(result.vehicle_hours, 2.0 * (result.time_s - result.first_goal_s) / 3600.0, 1e-9);
  EXPECT_NEAR(result.plan_way_m, result.distance_m, 0.5);
  EXPECT_LE(result.own_way_m, result.plan_way_m);
  EXPECT_EQ(result.longest_wait_s > 0.0, !result.longest_wait.empty());
  EXPECT_LE(result.longest_standoff_s, result.longest_wait_s);
}

TEST(Site, AGoalInAWallFailsWithItsReason) {
  sim::Setup setup = hall_with_two_vehicles(1);
  setup.scenario.missions.front().goals_in_map = {{0.05, 0.05, 0.0}};
  setup.scenario.duration_s = 40.0;
  const Outcome outcome = drive(setup);
  EXPECT_EQ(outcome.result.goals_reached, 1);
  EXPECT_EQ(outcome.report.goals_missed(), 1);
  ASSERT_FALSE(outcome.report.goals.empty());
  bool told = false;
  for (const referee::GoalRecord& goal : outcome.report.goals)
    told = told || (goal.agv_id == "agv-1" && goal.reason.find("clearance") != std::string::npos);
  EXPECT_TRUE(told);
}

/// Two vehicles without missions in a hall, and twenty tasks from its left to its right.
sim::Setup hall_with_twenty_tasks() {
  sim::Setup setup;
  setup.grid = sim::hall(10.0, 8.0, 0.1);
  setup.scenario.name = "tasks";
  setup.scenario.duration_s = 400.0;
  sim::add_vehicle(setup, 1, {5.0, 2.0, 0.0}, {});
  sim::add_vehicle(setup, 2, {5.0, 6.0, 3.1}, {});
  setup.scenario.missions.clear();
  for (int i = 0; i < 20; ++i) {
    const double y_m = 1.5 + 1.2 * (i * 3 % 5);
    setup.scenario.tasks.push_back({{{2.5, y_m, 0.0}, {7.0, 8.0 - y_m, 0.0}}, false});
  }
  return setup;
}

TEST(Site, TasksWithoutAVehicleAreAllServedPickBeforeDrop) {
  const Outcome outcome = drive(hall_with_twenty_tasks());
  EXPECT_EQ(outcome.result.goals_reached, 40);
  EXPECT_EQ(outcome.report.goals_missed(), 0);
  EXPECT_EQ(outcome.report.contacts_moving_vehicle(), 0);
  EXPECT_EQ(outcome.report.ended_because, "all missions are over");

  std::map<std::string, const referee::GoalRecord*> goals;
  std::set<std::string> carriers;
  for (const referee::GoalRecord& goal : outcome.report.goals) goals[goal.goal_id] = &goal;
  for (int i = 0; i < 20; ++i) {
    const std::string task = "task-" + std::to_string(i);
    ASSERT_EQ(goals.count(task + "/pick") + goals.count(task + "/drop"), 2u) << task;
    const referee::GoalRecord& pick = *goals[task + "/pick"];
    const referee::GoalRecord& drop = *goals[task + "/drop"];
    EXPECT_LT(pick.decided_s, drop.decided_s) << task;
    EXPECT_EQ(pick.agv_id, drop.agv_id) << task;
    carriers.insert(pick.agv_id);
  }
  EXPECT_EQ(carriers.size(), 2u);
}

TEST(Site, AVehicleWithGoalsToComeIsNotDone) {
  sim::Setup setup = hall_with_two_vehicles(1);
  setup.scenario.missions.front().goals_in_map = {{3.5, 3.0, 0.0}, {13.0, 3.0, 0.0}};
  bool was_there = false;
  for (const double end_s : {4.0, 6.0, 8.0, 10.0}) {
    const Outcome outcome = drive(setup, {}, {[&](double t_s) { return t_s < end_s; }});
    was_there = was_there || outcome.result.reached.at(0) == 1;
    EXPECT_EQ(outcome.result.done_s.at(0), -1.0) << end_s;
  }
  EXPECT_TRUE(was_there);
  EXPECT_GT(drive(setup).result.done_s.at(0), 0.0);
}

TEST(Site, EndsWhenItsUserHasEnough) {
  const Outcome outcome = drive(hall_with_two_vehicles(1), {}, {[](double t_s) { return t_s < 3.0; }});
  EXPECT_EQ(outcome.report.ended_because, "stopped");
  EXPECT_LT(outcome.report.duration_s, 5.0);
}

TEST(SiteFaults, LossDelayDuplicatesAndOtherOrderAreCountedAndRepeatedExactly) {
  FaultPlan plan;
  plan.links.resize(1);
  plan.links[0].loss = 0.1;
  plan.links[0].delay_ms = 20.0;
  plan.links[0].jitter_ms = 10.0;
  plan.links[0].duplicates = 0.05;
  plan.links[0].reordered = 0.05;
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  const Outcome again = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  for (const char* kind : {"lost_packets", "delayed_packets", "duplicated_packets", "reordered_packets"})
    EXPECT_GT(outcome.faults.at(kind), 0u) << kind;
  EXPECT_EQ(outcome.faults, again.faults);
  EXPECT_EQ(outcome.result.trace_hash, again.result.trace_hash);
  EXPECT_NE(outcome.result.trace_hash, drive(hall_with_two_vehicles(1), {plan, 8}).result.trace_hash)
      << "another seed hits other packets";
}

TEST(SiteFaults, ALinkIsHarmedFromAMomentThatBinaryNumbersMissAndNoLongerThanToAnother) {
  FaultPlan plan;
  plan.links.resize(1);
  plan.links[0].begin_s = 2.01;
  plan.links[0].for_s = 2.01;
  plan.links[0].delay_ms = 20.0;
  const auto delayed_until = [&](double end_s) {
    return drive(hall_with_two_vehicles(1), faults_of(plan), {[&](double t_s) { return t_s < end_s; }})
        .faults["delayed_packets"];
  };
  EXPECT_EQ(delayed_until(1.0), 0u);
  EXPECT_GT(delayed_until(4.0), 0u);
  EXPECT_EQ(delayed_until(6.0), delayed_until(5.0));
}

TEST(SiteFaults, EveryServiceMayCrashOnceAndTheFleetGoesOn) {
  FaultPlan plan;
  double at_s = 2.0;
  for (const char* name :
       {"map", "global-planner", "obstacle-tracker", "local-planner-agv-1", "local-planner-agv-2", "dispatcher"}) {
    plan.crashes.push_back(once<Crash>(at_s, name));
    at_s += 2.0;
  }
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  EXPECT_EQ(outcome.faults.at("crash"), 6u);
  for (const auto& [instance, row] : outcome.report.services) {
    const bool was_hit = instance.find("fake-") != 0 && instance != "referee";
    EXPECT_EQ(row.starts, was_hit ? 2 : 1) << instance;
  }
}

TEST(SiteFaults, APartOfTheWorldThatCrashesGoesOnWhereItWas) {
  FaultPlan plan;
  plan.crashes.push_back(once<Crash>(4.0, "fake-vehicle-agv-1"));
  plan.crashes.push_back(once<Crash>(6.0, "fake-world"));
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
}

TEST(SiteFaults, AVehicleStandsWhileItsPlannerHangs) {
  FaultPlan plan;
  plan.hangs.push_back(once<Hang>(5.0, "local-planner-agv-1"));
  plan.hangs.front().for_s = 5.0;
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  EXPECT_EQ(outcome.faults.at("hang"), 1u);
  EXPECT_GT(outcome.result.done_s.at(0), drive(hall_with_two_vehicles(1)).result.done_s.at(0) + 4.0);
}

TEST(SiteFaults, AVehicleThatAPersonHoldsComesLaterAndIsExcused) {
  FaultPlan plan;
  plan.holds.push_back({"agv-1", 3.0, 3.0, 2.0, 2.0});
  plan.stop_s = 12.0;
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  EXPECT_EQ(outcome.faults.at("hold"), 3u);
  EXPECT_GT(outcome.result.done_s.at(0), drive(hall_with_two_vehicles(1)).result.done_s.at(0) + 2.0);
  EXPECT_LT(outcome.result.longest_standoff_s, 1.0) << outcome.result.longest_standoff;
}

TEST(SiteFaults, ADeadVehicleStaysWhereItIsUntilItIsSignedOffAndTheOtherPassesIt) {
  FaultPlan plan;
  plan.deaths.resize(1);
  plan.deaths[0].vehicle = "agv-2";
  plan.deaths[0].at_s = 6.0;
  plan.deaths[0].signed_off_after_s = 10.0;
  geometry::Pose2 dead_in_map, dead_at_end_in_map;
  std::vector<std::string> said;

  Hooks hooks;
  hooks.goes_on = [](double t_s) { return t_s < 30.0; };
  hooks.says = [&](const std::string& line) { said.push_back(line); };
  hooks.watch = [&](const Snapshot& now) {
    if (now.t_s < 9.0) dead_in_map = now.vehicles_in_map.at(1);
    dead_at_end_in_map = now.vehicles_in_map.at(1);
  };
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan), hooks);

  EXPECT_EQ(outcome.faults.at("death"), 1u);
  EXPECT_EQ(outcome.faults.at("sign_off"), 1u);
  EXPECT_THAT(said, ::testing::Contains(HasSubstr("agv-2 is signed off")));
  EXPECT_EQ(dead_in_map.position(), dead_at_end_in_map.position());
  EXPECT_EQ(outcome.result.reached, (std::vector<int>{1, 0}));
  EXPECT_EQ(outcome.report.contacts_moving_vehicle(), 0);
  EXPECT_TRUE(outcome.report.violations.empty());
}

TEST(SiteFaults, ASlowVehicleComesLater) {
  FaultPlan plan;
  plan.slows.push_back({"agv-1", 0.0, 60.0, 0.5});
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  EXPECT_EQ(outcome.faults.at("slow"), 1u);
  EXPECT_GT(outcome.result.done_s.at(0), drive(hall_with_two_vehicles(1)).result.done_s.at(0) + 4.0);
}

TEST(SiteFaults, ACutKeepsCommandsFromTheVehicleUntilItHeals) {
  FaultPlan plan;
  Cut cut;
  cut.at_s = 5.0;
  cut.for_s = 4.0;
  cut.from = "local-planner-agv-1";
  cut.to = "fake-vehicle-agv-1";
  cut.both_ways = false;
  plan.cuts.push_back(cut);
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  EXPECT_GT(outcome.faults.at("cut_packets"), 100u);
  EXPECT_GT(outcome.result.done_s.at(0), drive(hall_with_two_vehicles(1)).result.done_s.at(0) + 3.0);
}

TEST(SiteFaults, AWallClockMayJumpEitherWay) {
  for (const double by_s : {-3600.0, 3600.0}) {
    FaultPlan plan;
    for (const char* name : {"map", "global-planner", "obstacle-tracker", "local-planner-agv-1", "dispatcher"}) {
      plan.clock_jumps.push_back(once<ClockJump>(5.0, name));
      plan.clock_jumps.back().by_s = by_s;
    }
    const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
    expect_a_good_run(outcome);
    EXPECT_EQ(outcome.faults.at("clock_jump"), 5u);
  }
}

TEST(SiteFaults, AFullDiskRefusesAMapEditAndTheFleetDrivesOn) {
  sim::Setup setup = hall_with_two_vehicles(1);
  setup.scenario.map_edits.push_back({4.0, true, {6.0, 6.5}, {7.0, 7.5}});
  FaultPlan plan;
  plan.disks.push_back(once<DiskFault>(2.0, "map"));
  plan.disks.back().for_s = 30.0;
  const Outcome outcome = drive(setup, faults_of(plan));
  expect_a_good_run(outcome);
  ASSERT_EQ(outcome.report.edits.size(), 1u);
  EXPECT_THAT(outcome.report.edits.front().outcome, HasSubstr("refused"));
  EXPECT_THAT(drive(setup).report.edits.front().outcome, HasSubstr("applied"));
}

TEST(SiteFaults, AMapEditSurvivesACrashOfTheMap) {
  sim::Setup setup = hall_with_two_vehicles(1);
  setup.scenario.map_edits.push_back({3.0, true, {6.0, 6.5}, {7.0, 7.5}});
  FaultPlan plan;
  plan.crashes.push_back(once<Crash>(6.0, "map"));
  const Outcome outcome = drive(setup, faults_of(plan));
  expect_a_good_run(outcome);
  ASSERT_EQ(outcome.report.edits.size(), 1u);
  EXPECT_EQ(outcome.report.edits.front().outcome, "applied");
}

TEST(SiteFaults, TornAndLostFilesCostNoContact) {
  for (const char* kind : {"torn", "lost"}) {
    FaultPlan plan;
    plan.disks.push_back(once<DiskFault>(5.0, "dispatcher"));
    plan.disks.back().kind = kind;
    const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
    expect_a_good_run(outcome);
  }
}

TEST(SiteFaults, AShortFaultWithinALongOneNeitherEndsItNorIsCounted) {
  const double undisturbed_s = drive(hall_with_two_vehicles(1)).result.done_s.at(0);
  FaultPlan hangs;
  for (const auto& [at_s, for_s] : {std::pair(5.0, 5.0), std::pair(6.0, 0.5)}) {
    hangs.hangs.push_back(once<Hang>(at_s, "local-planner-agv-1"));
    hangs.hangs.back().for_s = for_s;
  }
  const Outcome hung = drive(hall_with_two_vehicles(1), faults_of(hangs));
  expect_a_good_run(hung);
  EXPECT_EQ(hung.faults.at("hang"), 1u);
  EXPECT_GT(hung.result.done_s.at(0), undisturbed_s + 4.0);

  FaultPlan crashes;
  for (const auto& [at_s, for_s] : {std::pair(5.0, 5.0), std::pair(6.0, 0.5)}) {
    crashes.crashes.push_back(once<Crash>(at_s, "local-planner-agv-1"));
    crashes.crashes.back().restart_after_s = for_s;
  }
  const Outcome crashed = drive(hall_with_two_vehicles(1), faults_of(crashes));
  expect_a_good_run(crashed);
  EXPECT_EQ(crashed.faults.at("crash"), 1u);
  EXPECT_GT(crashed.result.done_s.at(0), undisturbed_s + 4.0);

  sim::Setup setup = hall_with_two_vehicles(1);
  setup.scenario.map_edits.push_back({4.0, true, {6.0, 6.5}, {7.0, 7.5}});
  FaultPlan disks;
  for (const auto& [at_s, for_s] : {std::pair(2.0, 30.0), std::pair(2.5, 0.5)}) {
    disks.disks.push_back(once<DiskFault>(at_s, "map"));
    disks.disks.back().for_s = for_s;
  }
  const Outcome full = drive(setup, faults_of(disks));
  EXPECT_EQ(full.faults.at("disk_full"), 1u);
  EXPECT_THAT(full.report.edits.at(0).outcome, HasSubstr("refused"));
}

TEST(SiteFaults, ARestartedProcessDoesNotHangWithTheOldOne) {
  FaultPlan plan;
  plan.hangs.push_back(once<Hang>(5.0, "local-planner-agv-1"));
  plan.hangs.back().for_s = 30.0;
  plan.crashes.push_back(once<Crash>(6.0, "local-planner-agv-1"));
  plan.hangs.push_back(once<Hang>(9.0, "local-planner-agv-1"));
  const Outcome outcome = drive(hall_with_two_vehicles(1), faults_of(plan));
  expect_a_good_run(outcome);
  EXPECT_EQ(outcome.faults.at("hang"), 2u);
  EXPECT_LT(outcome.result.done_s.at(0), 35.0) << "the first hang would have ended then";
}

TEST(SiteFaults, AProcessThatDoesNotExistIsNamed) {
  FaultPlan plan;
  plan.crashes.push_back(once<Crash>(5.0, "local-planer-agv-1"));
  try {
    drive(hall_with_two_vehicles(1), faults_of(plan));
    FAIL() << "was driven";
  } catch (const config::BadInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("did you mean 'local-planner-agv-1'"));
  }
}

}  // namespace
}  // namespace aisle::sim
