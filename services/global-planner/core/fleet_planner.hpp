#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/grid/clearance.hpp"
#include "common/kinematics/limits.hpp"
#include "common/time/stamp.hpp"
#include "services/global-planner/core/connected_parts.hpp"
#include "services/global-planner/core/fleet_types.hpp"
#include "services/global-planner/core/path_progress.hpp"
#include "services/global-planner/core/planner.hpp"
#include "services/global-planner/core/stamped_discs.hpp"

namespace aisle::global_planner {

/// What a vehicle of this footprint and model needs of the floor. One that turns on the spot may turn anywhere: the
/// circle around it keeps clear. One that does not gets plans with arcs twice as wide as its tightest, so that it can
/// correct what it drives.
VehicleShape shape_of(const geometry::Footprint& footprint, const kinematics::Limits& limits);

/// Decides when each vehicle of a fleet needs a plan, and makes it. Reads no clock and knows no DDS: each call says
/// what time it is.
///
///   new goal ──────────────► plan ──► kept ◄──────────────────┐ not blocked: same plan, new revision
///   map changed ─► is what remains of the plan blocked? ──────┤
///   static track, parked vehicle, blocked report on the way ──┴ blocked ─► new plan around it; none: keep the old one
///   no path ─► tried again, ever less often, and when the map changes
///
/// At most 1024 vehicles and 1024 static tracks are kept; further ones are ignored.
/// Obstacles that the map does not show (static tracks, parked or silent vehicles, a vehicle's own reports) never make
/// a goal unreachable: where there is no way around them, the plan leads through, and the local planner waits in front.
class FleetPlanner {
 public:
  FleetPlanner(const FleetSettings& settings, std::unique_ptr<Planner> planner);

  /// A new complete map. `low` to `high` (both included) hold all cells that differ from the map before.
  /// `grid` is not copied: it must live, unchanged, until the next call.
  void set_map(const std::string& map_id, std::uint64_t revision, const grid::OccupancyGrid& grid, grid::Cell low,
               grid::Cell high);

  void set_map(const std::string& map_id, std::uint64_t revision, grid::OccupancyGrid&& grid, grid::Cell low,
               grid::Cell high) = delete;

  /// Outline and model of a vehicle; makes it known.
  void set_vehicle(const std::string& agv_id, const VehicleShape& shape);

  void set_vehicle(const std::string& agv_id, double radius_m) {
    set_vehicle(agv_id, VehicleShape{radius_m, radius_m, 0.0, {}});
  }

  /// Where a vehicle is, in map; how long it has stood there is kept.
  void set_pose(const std::string& agv_id, const geometry::Pose2& base_in_map, time::Stamp now);

  /// The newest goal of a vehicle; the same goal again changes nothing.
  void set_goal(const Goal& goal);

  /// What a vehicle says about its way: reports of blocks are remembered, `arrived` ends the goal.
  void set_navigation(const NavigationStatus& navigation, time::Stamp now);

  /// Drops all that is known of a vehicle.
  void forget_vehicle(const std::string& agv_id);

  /// A static obstacle that the tracker sees; it stays until dropped.
  void set_static_track(std::uint64_t track_id, const Disc& disc);
  void drop_track(std::uint64_t track_id) { static_tracks_.erase(track_id); }

  /// Takes over a plan that another planner published: it is checked and published again as ours, waypoints unchanged.
  void adopt(const Plan& plan);

  /// All plans that stand, also those of this planner, are checked and published again.
  void take_over();

  /// The next plan to publish, after working for at most one vehicle; call it again until there is none.
  std::optional<Plan> step(time::Stamp now, const OutOfTime& out_of_time);

  /// Nothing will be asked for some time: the search's memory is given back until then.
  void rest() {
    planner_->rest();
    if (steered_) steered_->rest();
  }

  /// What happened since the last call, one line each.
  std::vector<std::string> take_events();

  /// What keeps a vehicle with a goal from being planned for, e.g. "map_info, vehicle_info of agv-2"; empty: nothing.
  std::string waits_for(time::Stamp now) const;

  /// 0: no map yet.
  std::uint64_t map_revision() const { return map_revision_; }

  /// Searches made so far.
  std::uint64_t searches() const { return searches_; }

 private:
  /// A place at which a vehicle says that something blocks its way.
  struct Report {
    Disc disc;
    time::Stamp newest;
  };

  /// All that is known of one vehicle.
  struct VehicleEntry {
    std::string id;
    std::optional<double> radius_m;  // of what keeps clear of walls
    VehicleShape shape;

    time::Latest<geometry::Pose2> pose;
    geometry::Point2 stands_at;  // anchor: left when it moves 5 cm away
    time::Stamp stands_since{};
    std::optional<Goal> goal;
    std::optional<NavigationStatus> navigation;

    time::Stamp navigation_arrived{};
    std::vector<Report> reports;
    std::optional<Plan> plan;
    Goal planned_for;              // the goal that the plan was made for
    bool leads_to_nearest{false};  // it cannot be reached: the plan ends at the nearest point that can
    bool is_adopted{false};
    PathProgress progress;

    time::Stamp next_attempt{};
    double wait_s{0.0};  // doubles while attempts do not help
  };

  /// What a plan must lead around: the disc, what kind of change it makes, and its name for messages.
  struct Obstacle {
    Disc disc;
    PlanTrigger trigger;
    std::string name;
  };

  /// One vehicle's turn: the first thing that is due for it.
  std::optional<Plan> attend(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// A plan that says that the goal was cancelled.
  std::optional<Plan> cancel(VehicleEntry& vehicle);

  /// Another map: keeps the plan under the new revision, or replaces it.
  std::optional<Plan> check_map(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// Another search for a goal that had no path.
  std::optional<Plan> retry(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// A plan around what stands on the way, if there is one.
  std::optional<Plan> check_obstacles(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// A plan for the vehicle's goal that has no way yet.
  Plan blank_plan(const VehicleEntry& vehicle) const;

  /// Searches with obstacles, without them, and to the nearest point, until one is found.
  Plan plan_anew(const VehicleEntry& vehicle, PlanTrigger trigger, time::Stamp now, const OutOfTime& out_of_time);

  /// Numbers the plan, remembers and returns it.
  std::optional<Plan> publish(VehicleEntry& vehicle, Plan plan, time::Stamp now);

  /// The next attempt is due after twice the time of the last one.
  void put_off(VehicleEntry& vehicle, time::Stamp now);

  /// To the point nearest to the goal that can be reached.
  PlannedPath search_nearest(const VehicleEntry& v, const OutOfTime& out_of_time);

  /// Do start and goal lie in different parts of the map, as far as the parts are known?
  bool is_known_unreachable(const Problem& problem) const;

  /// Searches with the discs of `around` stamped into the clearance field.
  PlannedPath search(const VehicleEntry& vehicle, const std::vector<Obstacle>& around, const OutOfTime& out_of_time);
  /// Is it planned for by the planner that knows steering?
  bool is_steered(const VehicleEntry& vehicle) const {
    return vehicle.shape.turning_radius_m > 0.0 && !settings_.as_printed;
  }
  Problem problem_of(const VehicleEntry& vehicle, geometry::Point2 start_in_map, geometry::Point2 goal_in_map) const;

  /// Is what remains of the plan free in the newest map?
  bool is_rest_free(const VehicleEntry& vehicle) const;

  /// Why there is no plan, for people.
  std::string why(const VehicleEntry& vehicle, Outcome outcome, const OutOfTime& out_of_time);

  /// What stands in this vehicle's way and is in no map.
  std::vector<Obstacle> obstacles_for(const VehicleEntry& vehicle, time::Stamp now) const;

  /// Does it stand where it will stay: silent, without a goal, arrived, held or failed?
  const Obstacle* first_on_the_way(const VehicleEntry& vehicle, const std::vector<Obstacle>& obstacles) const;
  bool is_parked(const VehicleEntry& vehicle, time::Stamp now) const;

  /// Does the vehicle say, of the plan that it has, that it is blocked?
  bool is_blocked_on_its_plan(const VehicleEntry& vehicle, time::Stamp now) const;

  /// The clearance field anew, up to reach_m_.
  void rebuild_clearance();

  /// The entry of the vehicle, made when it is new; null when there are too many.
  VehicleEntry* vehicle(const std::string& agv_id);

  FleetSettings settings_;
  std::unique_ptr<Planner> planner_;

  /// For vehicles that cannot turn on the spot; made when the first of them is heard of.
  std::unique_ptr<Planner> steered_;

  std::string map_id_;
  std::uint64_t map_revision_{0};  // 0: no map yet
  const grid::OccupancyGrid* grid_{nullptr};

  grid::ClearanceField clearance_;
  ConnectedParts parts_;  // of the map, for the radius last asked for
  double reach_m_{2.0};   // the clearance field's cap; grows with the largest vehicle
  std::map<std::string, VehicleEntry> vehicles_;
  std::map<std::uint64_t, Disc> static_tracks_;
  std::uint64_t next_plan_id_{1};
  std::uint64_t searches_{0};
  std::string last_attended_;  // vehicles take turns
  std::vector<std::string> events_;
};

}  // namespace aisle::global_planner
