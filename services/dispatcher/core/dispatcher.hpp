#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/scenario/scenario.hpp"
#include "common/time/stamp.hpp"

namespace aisle::dispatcher {

/// Tolerances of the goals and the times of a mission's course.
struct Settings {
  double position_tolerance_m{0.15};
  double yaw_tolerance_rad{0.15};  // where the heading matters
  double pause_s{0.5};             // between a goal and the next
  double retry_s{5.0};             // after a failure, before the goal is given again
  int attempts{4};                 // then the vehicle goes on to its next goal
  double greet_s{2.0};             // a vehicle may take so long to tell what it was doing before it gets its first goal
  double repeat_s{3.0};            // a goal is given again to a vehicle that has nothing to do
  double silent_s{5.0};            // without a vehicle's word; then its task is given to another one
  double patience_s{20.0};         // a task waits so long for a busy vehicle while another one is free

  template <class Reader>
  void describe(Reader& r) {
    r.field("position_tolerance_m", position_tolerance_m, 0.01, 5.0)
        .field("yaw_tolerance_rad", yaw_tolerance_rad, 0.01, 3.2)
        .field("pause_s", pause_s, 0.0, 3600.0)
        .field("retry_s", retry_s, 0.1, 3600.0)
        .field("attempts", attempts, 1, 1000)
        .field("greet_s", greet_s, 0.0, 60.0)
        .field("repeat_s", repeat_s, 0.1, 3600.0)
        .field("silent_s", silent_s, 0.5, 3600.0)
        .field("patience_s", patience_s, 0.0, 3600.0);
  }
};

/// A goal to be written.
struct Order {
  std::string agv_id;
  std::string goal_id;  // "agv-1/2": the third goal of its mission, the same after a restart
  geometry::Pose2 goal_in_map;
  double position_tolerance_m{0.0};
  double yaw_tolerance_rad{0.0};  // 0: any heading
  bool is_cancelled{false};       // the vehicle shall drop this goal
};

/// What a vehicle tells about its goal.
struct Status {
  enum class Phase { kIdle, kOnTheWay, kArrived, kFailed };  // idle: has no goal

  std::string goal_id;
  Phase phase{Phase::kIdle};
  std::string reason;
};

/// What was decided, for the log.
struct Event {
  enum class Kind { kReached, kFailed, kRetried, kCancelled, kMissionDone, kResumed, kGiven, kTakenBack };

  Kind kind;
  std::string agv_id;
  std::string goal_id;
  std::string reason;
};

/// How far a vehicle's mission is; what a restart needs.
struct Progress {
  std::uint64_t next{0};  // number, from 0, of the goal that was given last or is given next
  std::uint64_t reached{0};
  std::uint64_t failed{0};
  bool stopped{false};  // a person cancelled a goal
};

/// The progress of each mission, by the vehicle's id.
using Memory = std::map<std::string, Progress>;

/// Gives each vehicle the goals of its mission, one after the other.
///
///   greeting ──(it told its goal, or greet_s)──► on goal n ──arrived──► pause ──► on goal n+1 ... ──► done
///                                        failed ──retry_s──► given again, attempts times, then goal n+1
///                                        cancelled by a person ──► stopped
///
/// Reads no clock: each call says what time it is. Not for use from several threads.
class Dispatcher {
 public:
  /// @param missions one a vehicle
  /// @param memory what memory() gave before a restart, or null; without it a vehicle's own status tells the goal that
  /// it was on
  Dispatcher(const std::vector<scenario::Mission>& missions, const Settings& settings, const Memory* memory);

  /// A vehicle is there; its mission may begin. Vehicles without a mission are ignored.
  void vehicle_heard(const std::string& agv_id, time::Stamp now);

  /// What the vehicle tells about its goal: decides whether the goal is reached or has failed.
  void status_heard(const std::string& agv_id, const Status& status, time::Stamp now);

  /// A person cancelled this goal: the mission of its vehicle ends. Other goals are ignored.
  void cancelled(const std::string& agv_id, const std::string& goal_id);

  /// The goals to write now: next ones, and those to be given again.
  std::vector<Order> step(time::Stamp now);

  /// What was decided since the last call, oldest first.
  std::vector<Event> take_events();

  /// No mission has a goal left.
  bool all_done() const;

  /// Goals of all missions: given (the decided ones included), reached, and failed for good.
  std::uint64_t assigned() const;
  std::uint64_t reached() const;
  std::uint64_t failed() const;

  /// Vehicles with a mission that were not heard yet.
  std::vector<std::string> missing() const;

  /// Vehicles whose mission has not ended.
  std::set<std::string> engaged() const;

  /// What a new process needs to go on from here.
  Memory memory() const;

 private:
  enum class Stage { kUnseen, kGreeting, kGiving, kOnTheWay, kFailing, kEnded };

  /// One mission and how far it is.
  struct Book {
    scenario::Mission mission;
    Progress progress;
    Stage stage{Stage::kUnseen};
    std::optional<Status> status;  // the newest
    time::Stamp since{};           // of the newest order, or of the newest word that it drives
    time::Stamp due{};             // of the next order
    int attempts{0};
    bool remembered{false};
    std::string reason;
  };

  /// Goals of the mission in all, over its loops.
  std::uint64_t goal_count(const Book& book) const;
  std::string goal_id(const Book& book) const;

  /// The order to drive to the mission's present goal.
  Order order_of(const Book& book) const;

  /// The first status of a vehicle.
  void greet(Book& book, time::Stamp now);

  /// A status while the vehicle has a goal.
  void follow(Book& book, time::Stamp now);

  /// The goal is reached, or has failed for good: the next one is due after a pause.
  void decided(Book& book, bool reached, const std::string& reason, time::Stamp now);

  /// Adds an event for take_events().
  void tell(Event::Kind kind, const Book& book, const std::string& reason);

  Settings settings_;
  std::map<std::string, Book> books_;
  std::vector<Event> events_;
};

}  // namespace aisle::dispatcher
