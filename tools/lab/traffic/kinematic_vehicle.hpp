#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "services/global-planner/core/traffic/coordinator.hpp"

namespace aisle::lab {

/// A vehicle that follows its granted road exactly: it speeds up and brakes within its limits, cuts a corner by an arc
/// where the road behind the arc is granted as the arc begins, and otherwise stops at the corner and turns on the spot.
///
/// It stands for a local planner where only the traffic is judged: it has no scans, no tracker and no dynamic window.
class KinematicVehicle {
 public:
  KinematicVehicle(std::string agv_id, const global_planner::traffic::Kind& kind, const geometry::Pose2& start_in_map);

  /// Orders may come late, twice and in any order: the grant with the highest number counts, on the plan that it names.
  void hear(const global_planner::traffic::Way& way);
  void hear(const global_planner::traffic::GrantedRoad& grant);

  /// Drives for `dt_s` seconds.
  /// @param speed_share of the top speed of its kind
  /// @param is_held by a person: it brakes and stands
  /// @param in_sight people and things; it stops before one that stands in its granted road
  void drive(double dt_s, double speed_share, bool is_held, const std::vector<geometry::Body>& in_sight);

  global_planner::traffic::Report report() const;

  const std::string& id() const { return agv_id_; }
  const global_planner::traffic::Kind& kind() const { return kind_; }
  const geometry::Pose2& base_in_map() const { return base_in_map_; }
  double speed_mps() const { return speed_mps_; }
  bool is_turning() const { return is_turning_; }
  bool is_blocked() const { return blocker_.has_value(); }
  double driven_m() const { return driven_m_; }

  /// The newest grant that it heard: what it waits for, and why.
  const global_planner::traffic::GrantedRoad& newest_grant() const { return newest_; }

  /// Points of its way from where it is to its limit, the first and the last included.
  std::vector<geometry::Point2> road_ahead_in_map() const;

  /// The number of the step that it is in; steps below it are behind it.
  std::uint64_t step() const { return step_done_; }

 private:
  struct Corner {
    double at_m{0.0};            // along the way
    double reach_m{0.0};         // the arc begins so far before it and ends so far behind it
    double turn_rad{0.0};        // signed
    bool is_cusp{false};         // it drives back from here, or ahead again
    std::optional<bool> is_cut;  // decided as the arc begins
  };

  void take(const global_planner::traffic::Way& way);
  void obey_newest();
  void find_corners();
  void place_on_way();
  void decide_corners_behind();

  double end_of_step_m(std::uint64_t step) const;  // along the way; 0 for steps before its first
  double limit_m() const;
  double stop_at_m(const std::vector<geometry::Body>& in_sight);
  double allowed_mps(double stop_m, double speed_share) const;
  double wanted_heading_rad() const;
  bool turn_on_the_spot(double dt_s);
  void advance(double metres);
  geometry::Pose2 pose_at(double s_m) const;
  std::vector<global_planner::traffic::HeldPose> held() const;
  double blocked_from_m(const std::vector<geometry::Body>& in_sight);

  std::string agv_id_;
  global_planner::traffic::Kind kind_;
  geometry::Pose2 base_in_map_;
  double speed_mps_{0.0};
  bool is_turning_{false};
  bool is_held_{false};
  double driven_m_{0.0};
  std::optional<geometry::Body> blocker_;

  std::map<std::uint64_t, global_planner::traffic::Way> heard_ways_;  // by plan id, not older than the one it drives
  global_planner::traffic::GrantedRoad newest_;
  std::optional<global_planner::traffic::Way> way_;
  std::vector<double> along_m_;  // of each waypoint of the way
  std::vector<Corner> corners_;
  double s_m_{0.0};  // along the way
  std::uint64_t step_done_{0};
  std::uint64_t limit_step_{0};
  std::uint64_t obeyed_{0};  // number of the grant
};

}  // namespace aisle::lab
