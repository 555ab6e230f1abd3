#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/fleet/zone.hpp"
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

/// The own way of each vehicle to its goal, by the map alone and by the planner chosen for it, or why there is none.
/// What stands on the floor and is in no map, and other vehicles, are the traffic's affair: see TrafficPlanner. Reads
/// no clock and knows no DDS: each call says what time it is.
///
///   new goal ───► plan ──► kept ◄─────────────────────────────┐ not blocked: same plan, new revision
///   map changed ─► is what remains of the plan blocked? ──────┴ blocked ─► new plan
///   no path ─► tried again, ever less often, and when the map changes
///
/// At most 1024 vehicles are kept; further ones are ignored.
class FleetPlanner {
 public:
  FleetPlanner(const FleetSettings& settings, std::unique_ptr<Planner> planner);

  /// A new complete map. `low` to `high` (both included) hold all cells that differ from the map before.
  /// `grid` is not copied: it must live, unchanged, until the next call.
  void set_map(const std::string& map_id, std::uint64_t revision, const grid::OccupancyGrid& grid, grid::Cell low,
               grid::Cell high);

  void set_map(const std::string& map_id, std::uint64_t revision, grid::OccupancyGrid&& grid, grid::Cell low,
               grid::Cell high) = delete;

  /// Zones of the map. No goal may lie where nobody may enter or stop; that is said in words. The floor of keep-out
  /// zones is occupied in the map that set_map() is given; a vehicle that stands there gets a way out of it.
  void set_zones(const std::vector<fleet::Zone>& zones);

  /// Outline and model of a vehicle; makes it known.
  void set_vehicle(const std::string& agv_id, const VehicleShape& shape);

  void set_vehicle(const std::string& agv_id, double radius_m) {
    set_vehicle(agv_id, VehicleShape{radius_m, radius_m, 0.0, {}});
  }

  /// Where a vehicle is, in map.
  void set_pose(const std::string& agv_id, const geometry::Pose2& base_in_map, time::Stamp now);

  /// The newest goal of a vehicle; the same goal again changes nothing.
  void set_goal(const Goal& goal);

  /// What a vehicle says about its way: `arrived` ends the goal.
  void set_navigation(const NavigationStatus& navigation);

  /// All plans are made anew: another planner led until now.
  void take_over();

  /// Another leader has planned for this goal: the first plan of this planner for it says that it took over.
  void hear_plan(const std::string& agv_id, const std::string& goal_id);

  /// Its goal, though planned for, is planned for again.
  void plan_again(const std::string& agv_id);

  /// The next plan to publish, after working for at most one vehicle; call it again until there is none.
  std::optional<Plan> step(time::Stamp now, const OutOfTime& out_of_time);

  /// The vehicle's own way between two points of the map, around `standing` where that is possible, and not over
  /// `closed`, polygons in map; empty: none.
  /// @pre the vehicle and the map are known
  std::vector<geometry::Point2> own_way(const std::string& agv_id, geometry::Point2 from_in_map,
                                        geometry::Point2 to_in_map, const std::vector<Disc>& standing,
                                        const OutOfTime& out_of_time,
                                        const std::vector<std::vector<geometry::Point2>>& closed = {});

  /// The newest plan of the vehicle; null: none.
  const Plan* plan_of(const std::string& agv_id) const;

  /// The map with distances to walls; valid until the next set_map() or set_vehicle().
  const grid::ClearanceField& clearance() const { return clearance_; }

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
  /// All that is known of one vehicle.
  struct VehicleEntry {
    std::string id;
    std::optional<double> radius_m;  // of what keeps clear of walls
    VehicleShape shape;

    time::Latest<geometry::Pose2> pose;
    std::optional<Goal> goal;
    std::optional<NavigationStatus> navigation;

    std::optional<Plan> plan;
    Goal planned_for;              // the goal that the plan was made for
    bool leads_to_nearest{false};  // it cannot be reached: the plan ends at the nearest point that can
    bool is_taken_over{false};     // made under another leader
    std::string led_goal;          // that another leader has planned for
    bool is_doubted{false};        // the zones have changed since
    PathProgress progress;

    time::Stamp next_attempt{};
    double wait_s{0.0};  // doubles while attempts do not help
  };

  /// One vehicle's turn: the first thing that is due for it.
  std::optional<Plan> attend(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// A plan that says that the goal was cancelled.
  std::optional<Plan> cancel(VehicleEntry& vehicle);

  /// Another map: keeps the plan under the new revision, or replaces it.
  std::optional<Plan> check_map(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// Another search for a goal that had no path.
  std::optional<Plan> retry(VehicleEntry& vehicle, time::Stamp now, const OutOfTime& out_of_time);

  /// A plan for the vehicle's goal that has no way yet.
  Plan blank_plan(const VehicleEntry& vehicle) const;

  /// Searches to the goal, and where that is asked for to the nearest point.
  Plan plan_anew(const VehicleEntry& vehicle, PlanTrigger trigger, const OutOfTime& out_of_time);

  /// Numbers the plan, remembers and returns it.
  std::optional<Plan> publish(VehicleEntry& vehicle, Plan plan, time::Stamp now);

  /// The next attempt is due after twice the time of the last one.
  void put_off(VehicleEntry& vehicle, time::Stamp now);

  /// The zone that the vehicle's goal may not lie in; null: there is none.
  const fleet::Zone* zone_at_goal(const VehicleEntry& vehicle) const;

  /// From within a keep-out zone: straight to the nearest spot outside, and on to the goal.
  PlannedPath search_out_of_zone(const VehicleEntry& vehicle, const OutOfTime& out_of_time);

  /// To the point nearest to the goal that can be reached.
  PlannedPath search_nearest(const VehicleEntry& v, const OutOfTime& out_of_time);

  /// Do start and goal lie in different parts of the map, as far as the parts are known?
  bool is_known_unreachable(const Problem& problem) const;

  PlannedPath search(const VehicleEntry& vehicle, geometry::Point2 start_in_map, geometry::Point2 goal_in_map,
                     const OutOfTime& out_of_time);

  /// Is it planned for by the planner that knows steering?
  bool is_steered(const VehicleEntry& vehicle) const {
    return vehicle.shape.turning_radius_m > 0.0 && !settings_.as_printed;
  }
  Problem problem_of(const VehicleEntry& vehicle, geometry::Point2 start_in_map, geometry::Point2 goal_in_map) const;

  /// Is what remains of the plan free in the newest map?
  bool is_rest_free(const VehicleEntry& vehicle) const;

  /// Why there is no plan, for people.
  std::string why(const VehicleEntry& vehicle, Outcome outcome, const OutOfTime& out_of_time);

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
  std::vector<fleet::Zone> zones_;
  ConnectedParts parts_;  // of the map, for the radius last asked for
  double reach_m_{2.0};   // the clearance field's cap; grows with the largest vehicle
  std::map<std::string, VehicleEntry> vehicles_;
  std::uint64_t next_plan_id_{1};
  std::uint64_t searches_{0};
  std::string last_attended_;  // vehicles take turns
  std::vector<std::string> events_;
};

}  // namespace aisle::global_planner
