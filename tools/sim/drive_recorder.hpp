#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "common/service/shell.hpp"
#include "tools/sim/result.hpp"
#include "tools/sim/standoffs.hpp"

namespace aisle::sim {

/// Notes how vehicles drive, from ground truth and from what they report: smoothness, plans, how long they stood with a
/// goal, on whose way they drove, and a hash of every pose.
/// What the referee judges (contacts, goals, distances) is not noted here.
class DriveRecorder {
 public:
  /// Listens to the topics of `shell` from now on.
  explicit DriveRecorder(service::Shell& shell);
  DriveRecorder(const DriveRecorder&) = delete;
  DriveRecorder& operator=(const DriveRecorder&) = delete;

  /// Looks at which vehicles stand. To be called often: stands are measured to the time between two calls.
  void look(time::Stamp now);

  /// Puts its figures into `result`.
  void fill(Result& result) const;

  /// Where this vehicle truly is; none before it was heard of.
  std::optional<geometry::Point2> place_in_map(const std::string& agv_id) const {
    const auto vehicle = vehicles_.find(agv_id);
    return vehicle == vehicles_.end() ? std::nullopt : vehicle->second.place_in_map;
  }

  /// FNV-1a over the true poses of all bodies with their stamps, in the order in which they were
  /// published.
  std::uint64_t trace_hash() const { return trace_hash_; }

 private:
  /// The newest motion of a vehicle, to compare the next with.
  struct VehicleEntry {
    bool has_state{false};
    double mps{0.0}, mps2{0.0}, turn_radps{0.0};
    std::string planned_goal;  // whose first plan was measured

    // What it does, as far as it was heard.
    bool is_moving{false};  // or turns
    bool is_held{false};    // by a person
    std::optional<fleet::Goal> goal;
    std::string ended_goal;  // that it said to have reached, or failed at, last
    std::optional<fleet::NavigationStatus> navigation;
    time::Stamp navigation_arrived{};
    std::string stands_because;  // its words while it stood last
    fleet::Grant grant;
    fleet::Plan plan;
    std::optional<geometry::Point2> place_in_map;  // true
  };

  /// For the watch on stand-offs.
  static Doing doing(VehicleEntry& vehicle, time::Stamp now);

  /// Is the step that it is on one of its own way, as all of a plan without steps?
  static bool is_on_own_way(const VehicleEntry& vehicle);

  /// Each notes what its topic tells.
  void take(const fleet::Obstacle& obstacle, std::int64_t stamp_ns);
  void take(const fleet::VehicleState& state);
  void take(const fleet::Plan& plan);

  std::map<std::string, VehicleEntry> vehicles_;
  std::uint64_t trace_hash_{14695981039346656037ULL};
  double planned_m_{0.0};
  int turn_sign_changes_{0};
  double jerk_squared_sum_{0.0};
  std::uint64_t jerk_samples_{0};

  StandoffWatch standoffs_;
  time::Stamp begun_;
  std::optional<time::Stamp> leader_heard_;  // newest beat of a leading planner; none where nobody plans the traffic
  double own_way_m_{0.0};
  double plan_way_m_{0.0};
};

}  // namespace aisle::sim
