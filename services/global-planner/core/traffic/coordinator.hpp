#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/global-planner/core/traffic/joint_plan.hpp"
#include "services/global-planner/core/traffic/lock.hpp"

namespace aisle::global_planner::traffic {

/// What a vehicle says of its progress (from navigation_status and vehicle_state).
struct Report {
  std::string agv_id;
  geometry::Pose2 base_in_map;
  double speed_mps{0.0};
  std::uint64_t plan_id{0};       // that it drives
  std::uint64_t step_done{0};     // steps behind it, in absolute numbers
  std::uint64_t limit_step{0};    // it will stop at the end of this step at the latest
  std::uint64_t grant_number{0};  // that it obeys
  double stray_m{0.0};            // of its outline, off the path
  bool is_held{false};            // by a person
  bool is_blocked{false};         // by something that it sees in its tube; stands there
  geometry::Point2 blocked_at_in_map;
  double blocked_radius_m{0.0};
};

/// A way to drive, as far as it is planned: the turning points, where each step ends along it, and its number.
struct Way {
  std::string agv_id;
  std::uint64_t plan_id{0};
  std::uint64_t first_step{0};       // number of the step that begins at the first point
  std::vector<geometry::Point2> waypoints_in_map;
  std::vector<double> headings_rad;  // at each point, for kinds that do not turn on the spot
  std::vector<double> step_ends_m;   // along the way, of first_step, first_step + 1, ...
  bool leads_to_goal{false};
  std::string own_or_roadmap;        // name of the planner, "roadmap", or both
};

/// How far a vehicle may drive on which plan.
struct GrantedRoad {
  std::string agv_id;
  std::uint64_t number{0};
  std::uint64_t plan_id{0};
  std::uint64_t limit_step{0};  // it may drive to the end of the step before this number: steps below it are granted
  double limit_m{0.0};          // the same along the plan
  bool gives_back{false};       // asks to give back what lies beyond limit_step
  std::vector<std::string> waits_for;
  std::string reason;
};

/// What a step of the coordinator comes to: only what changed.
struct Orders {
  std::vector<Way> ways;
  std::vector<GrantedRoad> grants;
  std::vector<std::string> events;  // for the log
};

/// The vehicle's own way from here to there by the planner chosen for it; empty: none.
using OwnWay = std::function<std::vector<geometry::Point2>(const std::string& agv_id, geometry::Point2 from_in_map,
                                                           geometry::Point2 to_in_map)>;

/// Decides when is planned for whom, and grants road. Pure: time comes in as seconds, orders go out.
///
///   goals, reports, map, things that stand ─► closures ─► plans of those without (own way, roadmap, group, all)
///                                                      ─► retiming ─► grants: links done, lock admits ─► orders
class Coordinator {
 public:
  struct Settings {
    double gap_m{0.05};
    double tube_m{0.10};
    double silent_s{2.0};
    double latency_s{0.3};
    double least_ahead_m{4.0};
    std::size_t most_steps_ahead{30};
  };

  Coordinator(const Settings& settings, OwnWay own_way);

  void set_map(const grid::ClearanceField& clearance, grid::Cell low, grid::Cell high);
  void set_vehicle(const std::string& agv_id, const Kind& kind);

  /// The newest pose of the vehicle; makes it a part of the traffic once its kind and the map are known.
  void hear(const Report& report, double now_s);

  /// @param goal_in_map none: it has no goal (any more)
  void set_goal(const std::string& agv_id, const std::string& goal_id, const std::optional<geometry::Pose2>& goal_in_map,
                double now_s);

  /// Something that stands on the floor and is in no map; an empty shape ends it.
  void set_standing(const std::string& name, const Shape& shape, double now_s);

  /// A person says that the vehicle is gone.
  void sign_off(const std::string& agv_id);

  /// Works for one slice; call it again at once while `is_busy()`.
  Orders step(double now_s);
  bool is_busy() const;

  std::uint64_t refused() const;  // motions that the lock refused though their links were done: stays 0
  std::uint64_t circles() const;

 private:
  // see coordinator.cpp
};

}  // namespace aisle::global_planner::traffic
