#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/fleet/claim.hpp"
#include "common/fleet/coverage.hpp"
#include "common/fleet/grant.hpp"
#include "common/fleet/sign_off.hpp"
#include "common/fleet/traffic_status.hpp"
#include "common/fleet/vehicle.hpp"
#include "common/fleet/vehicle_state.hpp"
#include "common/fleet/zone.hpp"
#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/seen_floor.hpp"
#include "services/global-planner/core/traffic/coordinator.hpp"

namespace aisle::global_planner {

/// What the fleet is to be told: only what changed.
struct FleetOrders {
  std::vector<Plan> plans;
  std::vector<fleet::Grant> grants;

  bool empty() const { return plans.empty() && grants.empty(); }
};

/// The plans and grants of the whole fleet, from what its vehicles, the map and the tracker say. Each goal is looked at
/// alone first (FleetPlanner: can it be reached, and by which way of the vehicle's own planner), then all together
/// (traffic::Coordinator: who drives where, in which order, and how far).
///
///   goals ─► FleetPlanner ─┬─ no way, cancelled ─────────────────────────► plan that says so
///                          └─ way ─► Coordinator ◄─ states, statuses, tracks
///                                        └─► plans with steps, grants
///
/// With FleetSettings::as_printed there is no traffic: the ways of the FleetPlanner are the plans.
/// Reads no clock and knows no DDS: each call says what time it is.
class TrafficPlanner {
 public:
  TrafficPlanner(const FleetSettings& settings, std::unique_ptr<Planner> planner);
  TrafficPlanner(const TrafficPlanner&) = delete;
  TrafficPlanner& operator=(const TrafficPlanner&) = delete;

  /// See FleetPlanner::set_map.
  void set_map(const std::string& map_id, std::uint64_t revision, const grid::OccupancyGrid& grid, grid::Cell low,
               grid::Cell high);

  /// Zones of the map; a change acts like an edit of it.
  void set_zones(const std::vector<fleet::Zone>& zones, time::Stamp now);

  void set_vehicle(const fleet::Vehicle& vehicle);
  void set_state(const fleet::VehicleState& state, time::Stamp now);
  /// A vehicle that had its goal before this planner began takes part: see expect(). A goal that was reached and is
  /// given again, after its vehicle was moved out of the way, is driven to again: nobody heard that it was reached.
  void set_goal(const Goal& goal);

  /// @param boot_id of the vehicle's local planner
  void set_navigation(const NavigationStatus& navigation, std::uint64_t boot_id, time::Stamp now);

  /// A static obstacle that the tracker sees. Where it stood stays closed after drop_track() until somebody has seen
  /// the spot since, for kLongestUnseenS at most.
  void set_static_track(std::uint64_t track_id, const Disc& disc, time::Stamp now);
  void drop_track(std::uint64_t track_id, time::Stamp now);
  void set_coverage(const fleet::CoverageTile& tile, time::Stamp now) { seen_.set(tile, now); }

  /// A vehicle that others speak of takes part, though its build is not known yet: it may be anywhere.
  void expect(const std::string& agv_id);

  /// Another leader's plan for a goal, or without one: its vehicle takes part.
  void hear_plan(const std::string& agv_id, const std::string& goal_id);

  /// A person says that the vehicle drives no more. It holds all that it may still drive by its last word, or the place
  /// that the person names; a vehicle of which nothing is known leaves the traffic. Ends when it is heard again; a
  /// vehicle that is heard is not signed off.
  void sign_off(const fleet::SignOff& sign_off, time::Stamp now);

  /// Leads from now on. What vehicles may still drive is learned from their own words, and all plans are made anew.
  /// Nothing is granted until each known vehicle was heard or signed off. A status counts while it names this claim:
  /// else the vehicle may take grants of another planner.
  /// @param claim of this planner; an epoch above 1: another planner led before
  void take_over(time::Stamp now, const fleet::Claim& claim);

  /// Works for one slice; to be called again at once while is_busy().
  FleetOrders step(time::Stamp now, const OutOfTime& out_of_time);
  bool is_busy() const { return is_busy_; }

  /// `source_id`, `beat` and `slice_ms_p99` are left to the caller.
  fleet::TrafficStatus status(time::Stamp now) const;

  /// What happened since the last call, one line each.
  std::vector<std::string> take_events() { return std::exchange(events_, {}); }

  /// What keeps a vehicle with a goal from being planned for; empty: nothing.
  std::string waits_for(time::Stamp now) const { return goals_.waits_for(now); }

  /// See FleetPlanner.
  std::uint64_t searches() const { return goals_.searches(); }
  void rest() { goals_.rest(); }

  static constexpr double kLongestUnseenS = 120.0;

 private:
  /// All that is kept of one vehicle.
  struct Entry {
    traffic::Kind kind;
    time::Latest<fleet::VehicleState> state;
    std::optional<NavigationStatus> navigation;
    time::Stamp navigation_arrived{};
    std::uint64_t boot_id{0};  // of the local planner that said so
    bool is_heard{false};      // by the coordinator that is
    bool is_signed_off{false};
    std::optional<geometry::Point2> signed_off_at_in_map;  // where a person sees it
    bool is_incredible{false};                             // its newest status is not believed

    std::string planned_goal;  // of the newest plan with a way
    std::string reached_goal;  // by its own word; it may have been moved out of the way since
    std::optional<Plan> plan;  // as it was told last
    fleet::Grant grant;        // the same
    time::Stamp waits_since{};
  };

  /// Something that stands on the floor, as the coordinator knows it.
  struct Standing {
    Disc disc;
    std::optional<time::Stamp> lost;  // the tracker lost it then
  };

  /// Plans on the map from now on, with the floor of keep-out zones occupied. @param low to `high`: cells that differ
  void use_map(grid::Cell low, grid::Cell high);

  /// A coordinator that knows nothing yet but settings, map and vehicles.
  std::unique_ptr<traffic::Coordinator> new_coordinator();

  /// What the vehicle's newest words come to for the coordinator.
  void tell_coordinator(Entry& entry, const std::string& agv_id, time::Stamp now);

  /// Its newest words; without a status, or with one that is not believed, that it stands where it was heard.
  /// @pre its state was heard
  traffic::Report report_of(const std::string& agv_id, const Entry& entry) const;

  void tell_sign_off(const std::string& agv_id, const Entry& entry, time::Stamp now);

  /// Is there room for one more vehicle? If not, the first one that is refused is named.
  bool has_room_for(const std::string& agv_id);

  /// Where it was heard last.
  static std::optional<geometry::Pose2> last_pose(const Entry& entry);

  bool are_all_heard() const;

  /// At the beginning vehicles become known one after the other: are there still new ones?
  bool is_gathering(time::Stamp now);

  /// A plan for one goal by the map alone: a goal for the traffic, or a plan that says why there is none.
  void take_own_plan(Plan plan, time::Stamp now, FleetOrders& orders);

  void take_way(const traffic::Way& way, FleetOrders& orders);
  void take_grant(const traffic::GrantedRoad& road, time::Stamp now, FleetOrders& orders);

  /// Plans that go on under a new revision of the map are told anew. Not those whose vehicle is asked for road: it gets
  /// another plan.
  void refresh(FleetOrders& orders);

  /// Ends closures whose spot was seen free.
  void open_what_was_seen(time::Stamp now);

  std::vector<geometry::Point2> own_way(const std::string& agv_id, geometry::Point2 from_in_map,
                                        geometry::Point2 to_in_map);

  FleetSettings settings_;
  FleetPlanner goals_;
  SeenFloor seen_;

  std::string map_id_;
  std::uint64_t map_revision_{0};  // 0: no map yet
  grid::Cell map_high_{};
  const grid::OccupancyGrid* map_{nullptr};
  grid::OccupancyGrid floor_;  // the map with keep-out zones, when there are some
  std::vector<fleet::Zone> zones_;
  std::map<std::string, Entry> vehicles_;
  std::set<std::string> expected_;   // vehicles whose build is not known yet
  std::set<std::string> given_up_;   // the same, signed off
  bool has_refused_vehicle_{false};  // there were too many
  std::map<std::uint64_t, Standing> standing_;
  std::optional<time::Stamp> began_;  // to lead
  bool has_gathered_{false};          // the vehicles that were there when it began
  std::size_t gathered_{0};           // vehicles known at `gathered_last_`, when the newest of them was new
  time::Stamp gathered_last_{};
  fleet::Claim claim_;  // that it leads with
  bool is_busy_{false};
  OutOfTime out_of_time_;  // of the newest step
  std::vector<std::string> events_;

  std::unique_ptr<traffic::Coordinator> coordinator_;  // made from the members above
};

}  // namespace aisle::global_planner
