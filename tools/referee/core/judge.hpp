#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/referee/core/floor_watch.hpp"
#include "tools/referee/core/grant_watch.hpp"
#include "tools/referee/core/run_report.hpp"
#include "tools/referee/core/zone_watch.hpp"

namespace aisle::referee {

/// A plan that arrived.
struct PlanNews {
  std::string agv_id;
  std::uint64_t plan_id{0};
  std::string goal_id;
  std::uint64_t map_revision{0};
  bool found{false};
  std::string outcome;  // "no path: ...", for the report
  std::vector<geometry::Point2> waypoints_in_map;
  bool has_steps{false};  // its way is granted step by step
  double planning_ms{0.0};
  std::int64_t stamp_ns{0};  // when it was written
  double t_s{0.0};           // when it arrived
};

/// A velocity command that arrived.
struct CommandNews {
  std::string agv_id;
  std::int64_t stamp_ns{0};
  std::int64_t scan_stamp_ns{0};  // 0: knows of no scan
  double control_ms{0.0};
  double t_s{0.0};  // when it arrived
};

/// The map's answer to an edit.
struct EditAnswer {
  std::string edit_id;
  bool applied{false};
  std::string outcome;  // "applied", "refused: ..."
  std::uint64_t revision{0};
  double t_s{0.0};  // when it arrived
};

/// What a process says of its own load.
struct HealthNews {
  std::string instance;
  std::string service;
  std::uint64_t boot_id{0};
  double cpu_percent{0.0};
  double resident_mb{0.0};
};

/// How many goals a run should give, so that its end can be seen. Empty: this is not known, and the run
/// goes on until it is stopped.
struct Expectation {
  std::map<std::string, int> goals_of;  // by vehicle
  int goals_of_any{0};                  // of tasks: whichever vehicle is given them

  int goals() const;
};

/// Judges one simulated run from what is on the wire. Knows nothing of how planners work, and shares no
/// code with them. All moments are seconds since the start of the run on one clock; call `advance`
/// about ten times a second or more often.
class Judge {
 public:
  Judge(const Walls* walls, const Expectation& expectation);

  /// Ground truth; of one body in order of time.
  void body_seen(const BodySample& sample);
  void body_gone(const std::string& id);
  void zones_seen(const std::vector<fleet::Zone>& zones) { zones_.zones_seen(zones); }

  /// What the vehicles and the services say, each at its arrival.
  void vehicle_reported(const VehicleReport& report, std::uint64_t refused_commands);
  void plan_arrived(const PlanNews& plan);
  void grant_arrived(const std::string& agv_id, std::uint64_t plan_id, double limit_m);

  /// The vehicle's status names the plan.
  void plan_named(const std::string& agv_id, std::uint64_t plan_id, double t_s);

  /// See FloorWatch::road_said.
  void road_said(const std::string& agv_id, const std::vector<geometry::Pose2>& held_in_map, double t_s);
  void command_arrived(const CommandNews& command);
  void goal_arrived(const GoalRecord& goal, bool cancelled);
  void navigation_arrived(const GoalNews& news, bool waits);
  void edit_asked(const EditRow& edit);
  void edit_answered(const EditAnswer& answer);
  void health_arrived(const HealthNews& health);

  /// Judges contacts up to `until_s`: some tenths of a second behind the newest sample, so that none comes too late.
  void advance(double until_s);

  /// True when each vehicle was given all its goals and they are decided, or it has reported its goal
  /// as failed for kGiveUp_s; and all vehicles have stood for kSettle_s at `now_s`.
  bool is_over(double now_s) const;
  const ContactWatch& contacts() const { return contacts_; }
  const GoalBook& goals() const { return goals_; }
  std::size_t violations() const {
    return authority_.violations().size() + grants_.violations().size() + floor_.violations().size() +
           zones_.violations().size();
  }
  int vehicles_seen() const { return static_cast<int>(vehicles_.size()); }

  /// Closes the books. Scenario's name, seed and the like are the caller's.
  RunReport finish(double t_s);

  static constexpr double kSettle_s = 1.0;
  static constexpr double kGiveUp_s = 30.0;  // longer than a dispatcher goes on trying

 private:
  /// Everything of one vehicle.
  struct VehicleBook {
    VehicleRow row;
    bool holds{false};
    bool waits{false};
    double last_truth_s{-1.0};
    std::uint64_t truth_boot{0};
    double last_command_s{-1.0};
    std::int64_t last_scan_stamp_ns{0};
    std::string planned_goal;
    std::uint64_t plan_id{0};
    bool has_plan{false};
    std::uint64_t plan_revision{0};
    std::int64_t plan_stamp_ns{0};
  };

  /// An edit that was applied, until a plan of each vehicle that drove then has looked at it.
  struct PendingEdit {
    std::int64_t asked_stamp_ns;
    std::uint64_t revision;
    std::vector<std::string> waiting;  // vehicles whose plan has not been looked at since
  };

  VehicleBook& vehicle(const std::string& agv_id);

  /// As many goals were decided as are expected, and none is open that may still be reached.
  bool are_tasks_over(double now_s) const;

  /// Keeps a person's or a block's way, for the picture.
  void trace_body(const BodySample& sample);

  /// Notes how long after an edit a plan knew of it, in milliseconds.
  void edit_planned_for(std::int64_t asked_stamp_ns, std::int64_t plan_stamp_ns);

  ContactWatch contacts_;
  AuthorityWatch authority_;
  GrantWatch grants_;
  FloorWatch floor_;
  ZoneWatch zones_;
  GoalBook goals_;
  Expectation expectation_;
  std::map<std::string, VehicleBook> vehicles_;
  std::map<std::string, BodyTrace> bodies_;
  std::vector<EditRow> edits_;
  std::vector<PendingEdit> pending_edits_;
  std::map<std::string, ServiceRow> services_;
  std::map<std::string, std::uint64_t> boots_;
  Distribution planning_ms_, control_ms_, map_edit_to_plan_ms_;
};

}  // namespace aisle::referee
