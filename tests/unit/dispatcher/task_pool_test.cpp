#include "services/dispatcher/core/task_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace aisle::dispatcher {
namespace {

using geometry::Point2;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Phase = Status::Phase;

scenario::Scenario with_tasks(const std::vector<std::vector<geometry::Pose2>>& tasks) {
  scenario::Scenario scenario;
  for (const std::vector<geometry::Pose2>& stops : tasks) scenario.tasks.push_back({stops, false});
  return scenario;
}

/// Vehicles that drive straight at 1 m/s without meeting anybody; a step is 0.5 s.
class Hall {
 public:
  explicit Hall(std::map<std::string, Point2> places) {
    for (const auto& [id, place] : places) vehicles_[id].place = place;
  }

  void obey(const std::vector<Order>& orders) {
    for (const Order& order : orders) {
      Vehicle& vehicle = vehicles_.at(order.agv_id);
      said_.push_back((order.is_cancelled ? "-" : "") + order.agv_id + " " + order.goal_id);
      if (vehicle.is_dead) continue;
      if (order.is_cancelled && vehicle.goal_id == order.goal_id) vehicle.goal_id.clear();
      if (order.is_cancelled || vehicle.goal_id == order.goal_id) continue;
      vehicle.goal_id = order.goal_id;
      vehicle.goal = order.goal_in_map.position();
    }
  }

  void drive() {
    for (auto& [id, vehicle] : vehicles_) {
      const double left_m = geometry::distance(vehicle.place, vehicle.goal);
      if (vehicle.is_dead || vehicle.goal_id.empty() || left_m == 0.0) continue;
      vehicle.place = left_m <= 0.5 ? vehicle.goal : vehicle.place + (0.5 / left_m) * (vehicle.goal - vehicle.place);
      if (vehicle.place.x == vehicle.goal.x && vehicle.place.y == vehicle.goal.y)
        reached_.emplace_back(id, vehicle.goal_id);
    }
  }

  void tell(TaskPool& pool, time::Stamp now) const {
    for (const auto& [id, vehicle] : vehicles_) {
      if (vehicle.is_dead) continue;
      pool.vehicle_heard(id, 1.0, now);
      pool.place_heard(id, vehicle.place, now);
      const double left_m = vehicle.goal_id.empty() ? 0.0 : geometry::distance(vehicle.place, vehicle.goal);
      const Phase phase = vehicle.goal_id.empty() ? Phase::kIdle
                          : vehicle.fails         ? Phase::kFailed
                          : left_m == 0.0         ? Phase::kArrived
                                                  : Phase::kOnTheWay;
      pool.status_heard(id, {vehicle.goal_id, phase, vehicle.fails ? "no path" : ""}, left_m, now);
    }
  }

  void kill(const std::string& id) { vehicles_.at(id).is_dead = true; }
  void fail(const std::string& id, bool fails = true) { vehicles_.at(id).fails = fails; }
  void send(const std::string& id, const std::string& goal_id, Point2 goal) {
    vehicles_.at(id).goal_id = goal_id;
    vehicles_.at(id).goal = goal;
  }

  const std::vector<std::string>& said() const { return said_; }
  const std::vector<std::pair<std::string, std::string>>& reached() const { return reached_; }

 private:
  struct Vehicle {
    Point2 place;
    Point2 goal;
    std::string goal_id;
    bool is_dead{false};
    bool fails{false};
  };

  std::map<std::string, Vehicle> vehicles_;
  std::vector<std::string> said_;
  std::vector<std::pair<std::string, std::string>> reached_;
};

class Tasks : public ::testing::Test {
 protected:
  TaskPool pool_of(const std::vector<std::vector<geometry::Pose2>>& tasks,
                   const std::vector<TaskProgress>* memory = nullptr) {
    return TaskPool(tasks_of(with_tasks(tasks), settings_), settings_, memory);
  }

  /// Until all is done, at most `limit_s`.
  void run(TaskPool& pool, Hall& hall, double limit_s) {
    for (double s = 0.0; s < limit_s && !pool.all_done(); s += 0.5) {
      now_ += milliseconds(500);
      hall.tell(pool, now_);
      hall.obey(pool.step(engaged_, now_));
      hall.drive();
    }
  }

  Settings settings_;
  std::set<std::string> engaged_;
  time::Stamp now_{seconds(100)};
};

TEST_F(Tasks, HaveIdsOfTheirStops) {
  const std::vector<Task> tasks = tasks_of(with_tasks({{{1, 1, 0}}, {{2, 2, 0}, {3, 3, 0}}}), settings_);
  ASSERT_EQ(tasks.size(), 2u);
  EXPECT_EQ(tasks[0].stops.at(0).goal_id, "task-0");
  EXPECT_EQ(tasks[1].stops.at(0).goal_id, "task-1/pick");
  EXPECT_EQ(tasks[1].stops.at(1).goal_id, "task-1/drop");
}

TEST_F(Tasks, GoToTheVehicleThatServesThemSoonest) {
  TaskPool pool = pool_of({{{9, 0, 0}, {9, 5, 0}}, {{1, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {10, 0}}});
  run(pool, hall, 60.0);
  EXPECT_TRUE(pool.all_done());
  const std::vector<std::string> expected{"agv-2 task-0/pick", "agv-1 task-1", "agv-2 task-0/drop"};
  EXPECT_EQ(hall.said(), expected);
  EXPECT_EQ(pool.reached(), 3u);
  EXPECT_EQ(pool.assigned(), 3u);
}

TEST_F(Tasks, EqualTimesGoToTheLowerId) {
  TaskPool pool = pool_of({{{5, 0, 0}}});
  Hall hall({{"agv-2", {10, 0}}, {"agv-1", {0, 0}}});
  run(pool, hall, 60.0);
  EXPECT_EQ(hall.said().front(), "agv-1 task-0");
}

/// agv-1 is 2 m before its goal beside the task's place, agv-2 is free and 30 m away.
TEST_F(Tasks, WaitForABusyVehicleThatIsSoonerThere) {
  settings_.greet_s = 0.0;
  TaskPool pool = pool_of({{{0, 1, 0}}});
  Hall hall({{"agv-1", {2, 0}}, {"agv-2", {30, 0}}});
  hall.send("agv-1", "mine", {0, 0});
  run(pool, hall, 60.0);
  EXPECT_EQ(hall.said().front(), "agv-1 task-0");
}

TEST_F(Tasks, DoNotWaitLongForABusyVehicleThatDoesNotMove) {
  TaskPool pool = pool_of({{{0, 1, 0}}});
  Hall hall({{"agv-1", {2, 0}}, {"agv-2", {30, 0}}});
  for (int i = 0; i < 60; ++i) {
    now_ += milliseconds(500);
    hall.tell(pool, now_);
    pool.status_heard("agv-1", {"mine", Phase::kOnTheWay, ""}, 2.0, now_);  // stands
    hall.obey(pool.step(engaged_, now_));
  }
  ASSERT_FALSE(hall.said().empty());
  EXPECT_EQ(hall.said().front(), "agv-2 task-0");
}

TEST_F(Tasks, AreNotForVehiclesWithAMission) {
  TaskPool pool = pool_of({{{1, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {30, 0}}});
  engaged_ = {"agv-1"};
  run(pool, hall, 60.0);
  EXPECT_EQ(hall.said().front(), "agv-2 task-0");
}

TEST_F(Tasks, OfASilentVehicleBeginAnewWithAnother) {
  TaskPool pool = pool_of({{{2, 0, 0}, {20, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {30, 0}}});
  run(pool, hall, 8.0);  // on the way to the drop
  EXPECT_EQ(pool.reached(), 1u);
  hall.kill("agv-1");
  run(pool, hall, 120.0);
  EXPECT_TRUE(pool.all_done());
  // Given again to the vehicle that does not drive, before it counts as silent.
  const std::vector<std::string> expected{"agv-1 task-0/pick",  "agv-1 task-0/drop", "agv-1 task-0/drop",
                                          "-agv-1 task-0/drop", "agv-2 task-0/pick", "agv-2 task-0/drop"};
  EXPECT_EQ(hall.said(), expected);
  EXPECT_EQ(pool.reached(), 2u);
}

TEST_F(Tasks, ThatAVehicleCannotReachGoToAnother) {
  TaskPool pool = pool_of({{{2, 0, 0}, {20, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {30, 0}}});
  hall.fail("agv-1");
  run(pool, hall, 120.0);
  EXPECT_TRUE(pool.all_done());
  EXPECT_EQ(pool.reached(), 2u);
  EXPECT_EQ(hall.said().back(), "agv-2 task-0/drop");
}

TEST_F(Tasks, OfALoadedVehicleThatCannotGoOnStayWithIt) {
  TaskPool pool = pool_of({{{2, 0, 0}, {20, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {30, 0}}});
  run(pool, hall, 8.0);
  hall.fail("agv-1");
  run(pool, hall, 120.0);
  EXPECT_TRUE(pool.all_done());
  EXPECT_EQ(pool.failed(), 1u);
  EXPECT_EQ(std::count(hall.said().begin(), hall.said().end(), "agv-1 task-0/drop"), settings_.attempts);
  const std::vector<Event> events = pool.take_events();
  EXPECT_EQ(events.back().kind, Event::Kind::kFailed);
  EXPECT_EQ(events.back().reason, "no path");
}

TEST_F(Tasks, ThatNobodyCanReachFailAfterTheirAttempts) {
  TaskPool pool = pool_of({{{2, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {30, 0}}});
  hall.fail("agv-1");
  hall.fail("agv-2");
  run(pool, hall, 120.0);
  EXPECT_TRUE(pool.all_done());
  EXPECT_EQ(pool.failed(), 1u);
  EXPECT_EQ(pool.reached(), 0u);
}

TEST_F(Tasks, OfPeopleAreServedOnceHoweverOftenTheyAreSaid) {
  TaskPool pool = pool_of({});
  Hall hall({{"agv-1", {0, 0}}});
  const Task task{"aisle-7", {{"aisle-7", {1, 0, 0}, 0.25, 0.0}}};
  pool.add(task, now_);
  run(pool, hall, 30.0);
  pool.add(task, now_);
  run(pool, hall, 30.0);
  EXPECT_EQ(hall.said(), std::vector<std::string>{"agv-1 aisle-7"});
}

TEST_F(Tasks, ThatAPersonCancelsEnd) {
  TaskPool pool = pool_of({{{20, 0, 0}, {0, 0, 0}}});
  Hall hall({{"agv-1", {0, 0}}});
  run(pool, hall, 5.0);
  pool.cancelled("another");
  EXPECT_FALSE(pool.all_done());
  pool.cancelled("task-0/pick");
  EXPECT_TRUE(pool.all_done());
  EXPECT_EQ(pool.failed(), 2u);
}

TEST_F(Tasks, GoOnWithAMemory) {
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {30, 0}}});
  TaskPool before = pool_of({{{2, 0, 0}, {20, 0, 0}}, {{1, 1, 0}}});
  run(before, hall, 6.0);
  const std::vector<TaskProgress> memory = before.memory();
  TaskPool after = pool_of({{{2, 0, 0}, {20, 0, 0}}, {{1, 1, 0}}}, &memory);
  run(after, hall, 120.0);
  EXPECT_TRUE(after.all_done());
  EXPECT_EQ(after.reached(), 3u);
  EXPECT_EQ(hall.reached().size(), 3u);
}

TEST_F(Tasks, GoOnWithoutAMemoryByTheVehiclesWord) {
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {3, 0}}});
  hall.send("agv-1", "task-0/drop", {20, 0});
  TaskPool pool = pool_of({{{2, 0, 0}, {20, 0, 0}}});
  run(pool, hall, 60.0);
  EXPECT_TRUE(pool.all_done());
  EXPECT_TRUE(hall.said().empty());
}

/// Each pick comes before its drop, by the same vehicle.
TEST_F(Tasks, TwentyAreServedByThree) {
  std::vector<std::vector<geometry::Pose2>> tasks;
  for (int i = 0; i < 20; ++i) tasks.push_back({{(i * 7) % 20 + 0.5, 3, 0}, {(i * 11) % 20 + 0.5, 9, 0}});
  TaskPool pool = pool_of(tasks);
  Hall hall({{"agv-1", {0, 0}}, {"agv-2", {10, 0}}, {"agv-3", {20, 0}}});
  run(pool, hall, 1000.0);
  ASSERT_TRUE(pool.all_done());
  EXPECT_EQ(pool.reached(), 40u);
  ASSERT_EQ(hall.reached().size(), 40u);
  std::map<std::string, std::string> carriers;
  for (const auto& [agv_id, goal_id] : hall.reached()) {
    const std::string task = goal_id.substr(0, goal_id.find('/'));
    if (goal_id == task + "/pick") {
      EXPECT_TRUE(carriers.emplace(task, agv_id).second) << goal_id;
    } else {
      EXPECT_EQ(carriers[task], agv_id) << goal_id;
    }
  }
}

}  // namespace
}  // namespace aisle::dispatcher
