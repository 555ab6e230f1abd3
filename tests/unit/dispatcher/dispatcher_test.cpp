#include "services/dispatcher/core/dispatcher.hpp"

#include <gtest/gtest.h>

namespace aisle::dispatcher {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Phase = Status::Phase;

/// One vehicle with two goals; every call is a second later than the one before.
class Dispatching : public ::testing::Test {
 protected:
  Dispatching() {
    scenario::Mission mission;
    mission.vehicle = "agv-1";
    mission.goals_in_map = {{1, 1, 0}, {2, 2, 1}};
    missions_.push_back(mission);
  }
  std::string given(Dispatcher& dispatcher) {
    now_ += seconds(1);
    const std::vector<Order> orders = dispatcher.step(now_);
    return orders.empty() ? "" : orders.front().goal_id;
  }
  void say(Dispatcher& dispatcher, const std::string& goal_id, Phase phase, const std::string& reason = "") {
    now_ += seconds(1);
    dispatcher.status_heard("agv-1", {goal_id, phase, reason}, now_);
  }
  Dispatcher greeted(const Memory* memory = nullptr) {
    Dispatcher dispatcher(missions_, settings_, memory);
    dispatcher.vehicle_heard("agv-1", now_);
    say(dispatcher, "", Phase::kIdle);
    return dispatcher;
  }

  std::vector<scenario::Mission> missions_;
  Settings settings_;
  time::Stamp now_{seconds(100)};
};

TEST_F(Dispatching, GivesTheGoalsInOrderAndSaysWhenAllIsDone) {
  Dispatcher dispatcher = greeted();
  now_ += seconds(1);
  const std::vector<Order> orders = dispatcher.step(now_);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].goal_id, "agv-1/0");
  EXPECT_DOUBLE_EQ(orders[0].goal_in_map.x, 1.0);
  EXPECT_DOUBLE_EQ(orders[0].yaw_tolerance_rad, 0.0);
  say(dispatcher, "agv-1/0", Phase::kOnTheWay);
  EXPECT_EQ(given(dispatcher), "");
  say(dispatcher, "agv-1/0", Phase::kArrived);
  EXPECT_EQ(given(dispatcher), "agv-1/1");
  say(dispatcher, "agv-1/1", Phase::kArrived);
  EXPECT_EQ(given(dispatcher), "");
  EXPECT_TRUE(dispatcher.all_done());
  EXPECT_EQ(dispatcher.assigned(), 2u);
  EXPECT_EQ(dispatcher.reached(), 2u);
}

TEST_F(Dispatching, LoopsTheMission) {
  missions_[0].loops = 2;
  Dispatcher dispatcher = greeted();
  for (const std::string goal : {"agv-1/0", "agv-1/1", "agv-1/2", "agv-1/3"}) {
    EXPECT_EQ(given(dispatcher), goal);
    say(dispatcher, goal, Phase::kArrived);
  }
  given(dispatcher);
  EXPECT_TRUE(dispatcher.all_done());
}

TEST_F(Dispatching, WaitsForTheVehicleAndForWhatItHasToSay) {
  Dispatcher dispatcher(missions_, settings_, nullptr);
  EXPECT_EQ(given(dispatcher), "");
  EXPECT_EQ(dispatcher.missing(), std::vector<std::string>{"agv-1"});
  dispatcher.vehicle_heard("agv-1", now_);
  EXPECT_EQ(given(dispatcher), "");
  now_ += seconds(2);
  EXPECT_EQ(given(dispatcher), "agv-1/0");
}

TEST_F(Dispatching, AskingForTheHeadingIsTheMissionsChoice) {
  missions_[0].heading_matters = true;
  Dispatcher dispatcher = greeted();
  EXPECT_DOUBLE_EQ(dispatcher.step(now_).at(0).yaw_tolerance_rad, settings_.yaw_tolerance_rad);
}

TEST_F(Dispatching, AnOldArrivalIsNotOurs) {
  Dispatcher dispatcher = greeted();
  given(dispatcher);
  say(dispatcher, "agv-1/0", Phase::kArrived);
  EXPECT_EQ(given(dispatcher), "agv-1/1");
  say(dispatcher, "agv-1/0", Phase::kArrived);
  EXPECT_EQ(dispatcher.reached(), 1u);
}

TEST_F(Dispatching, AFailureIsTriedAgainThenLeftBehindWithItsReason) {
  Dispatcher dispatcher = greeted();
  EXPECT_EQ(given(dispatcher), "agv-1/0");
  say(dispatcher, "agv-1/0", Phase::kFailed, "no path");
  int again = 0;
  std::string goal;
  for (int i = 0; i < 60 && goal != "agv-1/1"; ++i) {
    goal = given(dispatcher);
    again += goal == "agv-1/0" ? 1 : 0;
  }
  EXPECT_EQ(goal, "agv-1/1");
  EXPECT_EQ(again, settings_.attempts - 1);
  EXPECT_EQ(dispatcher.failed(), 1u);
  bool told = false;
  for (const Event& event : dispatcher.take_events())
    told = told || (event.kind == Event::Kind::kFailed && event.reason == "no path");
  EXPECT_TRUE(told);
}

TEST_F(Dispatching, AFailureThatPassesIsNone) {
  Dispatcher dispatcher = greeted();
  given(dispatcher);
  say(dispatcher, "agv-1/0", Phase::kFailed, "no path");
  say(dispatcher, "agv-1/0", Phase::kOnTheWay);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(given(dispatcher), "");
    say(dispatcher, "agv-1/0", Phase::kOnTheWay);
  }
  say(dispatcher, "agv-1/0", Phase::kArrived);
  EXPECT_EQ(dispatcher.failed(), 0u);
  EXPECT_EQ(dispatcher.reached(), 1u);
}

TEST_F(Dispatching, AVehicleThatDoesNothingGetsItsGoalAgain) {
  Dispatcher dispatcher = greeted();
  EXPECT_EQ(given(dispatcher), "agv-1/0");
  say(dispatcher, "by-hand", Phase::kOnTheWay);
  now_ += seconds(1);
  EXPECT_EQ(given(dispatcher), "") << "a person's goal goes first";
  say(dispatcher, "by-hand", Phase::kArrived);
  now_ += seconds(3);
  EXPECT_EQ(given(dispatcher), "agv-1/0");
}

TEST_F(Dispatching, GoesOnWhereItWasByItsMemory) {
  Dispatcher before = greeted();
  given(before);
  say(before, "agv-1/0", Phase::kArrived);
  const Memory memory = before.memory();
  Dispatcher after(missions_, settings_, &memory);
  after.vehicle_heard("agv-1", now_);
  EXPECT_EQ(given(after), "agv-1/1");
  EXPECT_EQ(after.reached(), 1u);
}

TEST_F(Dispatching, WithoutMemoryTheVehicleTellsWhereItWas) {
  Dispatcher driving(missions_, settings_, nullptr);
  driving.status_heard("agv-1", {"agv-1/1", Phase::kOnTheWay, ""}, now_);  // before the vehicle itself
  driving.vehicle_heard("agv-1", now_);
  EXPECT_EQ(given(driving), "agv-1/1");
  EXPECT_EQ(driving.reached(), 1u);

  Dispatcher arrived(missions_, settings_, nullptr);
  arrived.vehicle_heard("agv-1", now_);
  say(arrived, "agv-1/1", Phase::kArrived);
  EXPECT_EQ(given(arrived), "");
  EXPECT_TRUE(arrived.all_done());
  EXPECT_EQ(arrived.reached(), 2u);
}

TEST_F(Dispatching, AnArrivalDuringTheRestartCounts) {
  Memory memory;
  memory["agv-1"].next = 1;
  memory["agv-1"].reached = 1;
  Dispatcher dispatcher(missions_, settings_, &memory);
  dispatcher.vehicle_heard("agv-1", now_);
  say(dispatcher, "agv-1/1", Phase::kArrived);
  given(dispatcher);
  EXPECT_TRUE(dispatcher.all_done());
}

TEST_F(Dispatching, ForeignGoalIdsDoNotConfuseTheStart) {
  for (const std::string id : {"agv-1/7", "agv-1/x", "agv-1/", "agv-11/1", "by-hand"}) {
    Dispatcher dispatcher(missions_, settings_, nullptr);
    dispatcher.vehicle_heard("agv-1", now_);
    say(dispatcher, id, Phase::kArrived);
    EXPECT_EQ(given(dispatcher), "agv-1/0") << id;
  }
}

TEST_F(Dispatching, ACancelledGoalEndsTheMission) {
  Dispatcher dispatcher = greeted();
  given(dispatcher);
  dispatcher.cancelled("agv-1", "agv-1/1");
  EXPECT_FALSE(dispatcher.all_done());
  dispatcher.cancelled("agv-1", "agv-1/0");
  EXPECT_TRUE(dispatcher.all_done());
  EXPECT_EQ(given(dispatcher), "");
  EXPECT_EQ(dispatcher.failed(), 1u);
}

}  // namespace
}  // namespace aisle::dispatcher
