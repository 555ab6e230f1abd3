#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/scenario/scenario.hpp"
#include "common/time/stamp.hpp"
#include "services/dispatcher/core/dispatcher.hpp"

namespace aisle::dispatcher {

/// A place that a task leads to.
struct TaskStop {
  std::string goal_id;  // "task-3/pick", the same for whichever vehicle serves it
  geometry::Pose2 goal_in_map;
  double position_tolerance_m{0.0};
  double yaw_tolerance_rad{0.0};  // 0: any heading
};

/// Work without a vehicle: stops in their order, all served by the same vehicle.
struct Task {
  std::string id;
  std::vector<TaskStop> stops;  // at least one
};

/// A task and how far it is; what a restart needs.
struct TaskProgress {
  enum class Stage { kPending, kGiven, kDone, kFailed };

  Task task;
  Stage stage{Stage::kPending};
  std::string agv_id;   // of the vehicle that serves it, or served it
  std::size_t next{0};  // stops behind it
  int attempts{0};      // that failed
};

/// The scenario's tasks: "task-0" with "task-0/pick" and "task-0/drop", or with the one goal "task-0".
std::vector<Task> tasks_of(const scenario::Scenario& scenario, const Settings& settings);

/// Gives each task to the vehicle that serves it soonest.
///
///   pending ──► given: stop 0 ──arrived──► pause ──► stop 1 ... ──► done
///      ▲                 │ silent: from stop 0 on to another vehicle
///      └─────────────────┘ failed before the first stop was reached: to another vehicle
///                          failed later (the vehicle is loaded): again to the same one
///                          failed `attempts` times in all: failed
///
/// How: tasks are looked at in the order in which they came. Soonest is the vehicle with the least time to the first
/// stop: what is left of its present work, then the straight way, at its top speed. Equal times: a free vehicle before
/// a busy one, then the lower id. A task whose vehicle is busy waits for it, but not longer than patience_s while a
/// vehicle is free. Vehicles with a mission of their own come in when that has ended.
///
/// Reads no clock: each call says what time it is. Not for use from several threads.
class TaskPool {
 public:
  /// @param memory what memory() gave before a restart, or null; without it the vehicles' own words tell which task
  /// they were on, and what was done before is served again
  TaskPool(const std::vector<Task>& tasks, const Settings& settings, const std::vector<TaskProgress>* memory);

  /// One more task; ignored when its id is known. @pre it has a stop
  void add(const Task& task, time::Stamp now);

  /// Which vehicle there is, and where it is.
  void vehicle_heard(const std::string& agv_id, double max_speed_mps, time::Stamp now);
  void place_heard(const std::string& agv_id, geometry::Point2 place_in_map, time::Stamp now);

  /// What a vehicle tells about its goal; `distance_left_m` on its way to it.
  void status_heard(const std::string& agv_id, const Status& status, double distance_left_m, time::Stamp now);

  /// A person cancelled this goal: its task has failed.
  void cancelled(const std::string& goal_id);

  /// The goals to write now. `engaged`: vehicles that have a mission of their own.
  std::vector<Order> step(const std::set<std::string>& engaged, time::Stamp now);

  /// What was decided since the last call, oldest first.
  std::vector<Event> take_events();

  /// No task is open.
  bool all_done() const;

  /// Stops of all tasks: given (the decided ones included), reached, and failed for good.
  std::uint64_t assigned() const;
  std::uint64_t reached() const;
  std::uint64_t failed() const;

  /// What a new process needs to go on from here.
  std::vector<TaskProgress> memory() const;

 private:
  using Stage = TaskProgress::Stage;

  /// A task and when it is looked at again.
  struct Entry {
    TaskProgress progress;
    time::Stamp since{};     // pending: since then; given: of the newest order, or of the newest word that it drives
    time::Stamp due{};       // of the next order
    bool is_ordered{false};  // the present stop was written
    bool is_failing{false};  // the vehicle says so
    std::set<std::string> tried;  // vehicles that could not reach the first stop
    std::string reason;

    const TaskStop& stop() const { return progress.task.stops[progress.next]; }
    bool is_open() const { return progress.stage == Stage::kPending || progress.stage == Stage::kGiven; }
  };

  /// The newest words of a vehicle.
  struct VehicleEntry {
    double max_speed_mps{1.0};
    std::optional<geometry::Point2> place_in_map;
    std::optional<Status> status;
    double distance_left_m{0.0};
    time::Stamp place_arrived{};
    time::Stamp status_arrived{};
  };

  /// When a vehicle is done with what it has, and where it is then.
  struct Free {
    double speed_mps{1.0};
    double way_m{0.0};  // before it is free
    geometry::Point2 end_in_map;
    bool is_now{true};
  };

  /// The task that this vehicle serves, or null.
  Entry* find_given_to(const std::string& agv_id);
  Entry* find_goal(const std::string& goal_id);

  bool is_silent(const std::string& agv_id, time::Stamp now) const;

  /// The vehicle tells that it is on a task that nobody has: after a restart without a memory.
  void take_up(const std::string& agv_id, const VehicleEntry& vehicle, time::Stamp now);

  /// A status of the vehicle that serves the task.
  void follow(Entry& entry, const Status& status, time::Stamp now);

  /// The present stop is reached.
  void arrive(Entry& entry, time::Stamp now);

  /// Orders of a task that has a vehicle.
  void continue_task(Entry& entry, time::Stamp now, std::vector<Order>& orders);

  /// The vehicle says that it cannot, for retry_s now.
  void give_up(Entry& entry, time::Stamp now, std::vector<Order>& orders);

  /// Takes the task from its vehicle: it begins anew with another one.
  void take_back(Entry& entry, const std::string& reason, time::Stamp now, std::vector<Order>& orders);

  /// The vehicles that may get tasks, by id.
  std::map<std::string, Free> candidates(const std::set<std::string>& engaged, time::Stamp now);

  /// The candidate that serves the task soonest; null: there is none.
  const std::string* soonest(const Entry& entry, const std::map<std::string, Free>& candidates, time::Stamp now) const;

  /// Gives pending tasks to vehicles that are free.
  void assign(const std::set<std::string>& engaged, time::Stamp now, std::vector<Order>& orders);

  /// The order to drive to the task's present stop.
  static Order order_of(const Entry& entry);

  void tell(Event::Kind kind, const Entry& entry, const std::string& reason);

  Settings settings_;
  std::vector<Entry> entries_;  // in the order in which they came
  std::map<std::string, VehicleEntry> vehicles_;
  bool remembers_{false};
  std::optional<time::Stamp> begun_;  // the first vehicle was heard
  std::vector<Event> events_;
};

}  // namespace aisle::dispatcher
