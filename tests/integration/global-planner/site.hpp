#pragma once
// A site around a global planner: the test plays the map, the vehicles and the dispatcher.
#include <unistd.h>

#include <map>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/fleet/claim.hpp"
#include "common/grid/clearance.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"
#include "common/wire/planning.hpp"
#include "common/wire/vehicle.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::global_planner {

using namespace std::chrono_literals;
using bus::SampleInfo;
using bus::SampleKind;

inline constexpr double kRadius_m = 0.3;

inline std::string partition() {
  return "planner-test-" + std::to_string(getpid());
}  // beside the same test in another process

inline bus::Settings site(int domain, const std::string& name) {
  bus::Settings settings = bus_test::loopback(domain, name);
  settings.partition = partition();
  return settings;
}

/// Everything else of a site: a hall of 20 x 10 m with two doors, and vehicles that say every 50 ms where they stand,
/// and which grant they obey. They never drive.
class Site {
 public:
  explicit Site(int domain)
      : bus(site(domain, "site")),
        grid(grid::Geometry{200, 100, 0.1, {}}),
        infos_(bus.writer<topics::MapInfo>()),
        tiles_(bus.writer<topics::MapTile>()),
        zones_(bus.writer<topics::MapZones>()),
        vehicles_(bus.writer<topics::VehicleInfo>()),
        states_(bus.writer<topics::VehicleState>()),
        goals_(bus.writer<topics::Goal>()),
        navigations_(bus.writer<topics::NavigationStatus>()),
        healths_(bus.writer<topics::ServiceHealth>()) {
    block(100, 0, 101, 99);
    block(100, 40, 101, 60, grid::Occupancy::kFree);
    block(100, 80, 101, 97, grid::Occupancy::kFree);
    bus.on<topics::Plan>([this](const aisle::Plan& sample, const SampleInfo& info) {
      if (info.kind != SampleKind::kData) return;
      plans.push_back(sample);
    });
    bus.on<topics::Grant>([this](const aisle::Grant& sample, const SampleInfo& info) {
      if (info.kind != SampleKind::kData) return;
      grants[sample.agv_id().to_string()] = sample;
    });
    bus.on<topics::TrafficStatus>([this](const aisle::TrafficStatus& sample, const SampleInfo& info) {
      if (info.kind == SampleKind::kData) traffic = sample;
      const fleet::Claim claim{sample.by().epoch(), sample.by().boot_id()};
      if (info.kind == SampleKind::kData && (obeyed_.epoch == 0 || outranks(claim, obeyed_))) obeyed_ = claim;
    });
    bus.every(50ms, [this] { publish_states(); });
  }

  void block(int x0, int y0, int x1, int y1, grid::Occupancy fill = grid::Occupancy::kOccupied) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) grid.set({x, y}, fill);
    }
  }

  void publish_map() {
    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = ++revision;
    summary.tiling = {64, grid.geometry()};
    for (int i = 0; i < summary.tiling.count(); ++i) {
      grid::Tile tile;
      tile.map_id = "hall";
      tile.tile_x = i % summary.tiling.tiles_x();
      tile.tile_y = i / summary.tiling.tiles_x();
      tile.revision = revision;
      tile.cells = grid::tile_cells(grid, summary.tiling, i);
      tile.hash = grid::tile_hash(tile.cells);
      summary.tile_hashes.push_back(tile.hash);
      tiles_.write(wire::encode(tile));
    }
    summary.hash = grid::map_hash(summary.tile_hashes);
    aisle::MapInfo sample = wire::encode(summary);
    stamp(sample.by());
    infos_.write(sample);

    aisle::MapZones zones = wire::encode(fleet::MapZones{"hall", revision, {}});
    stamp(zones.by());
    zones_.write(zones);
  }

  void add_vehicle(const std::string& id, const geometry::Pose2& pose) {
    add_vehicle(id, pose, geometry::disc(kRadius_m), {});
  }
  void add_vehicle(const std::string& id, const geometry::Pose2& pose, const geometry::Footprint& footprint,
                   const kinematics::Limits& limits) {
    aisle::VehicleInfo info = wire::encode(fleet::Vehicle{id, footprint, limits, 10.0, 0.2});
    stamp(info.by());
    vehicles_.write(info);
    poses_[id] = pose;
    publish_states();
  }

  void send_goal(const std::string& agv, const std::string& id, double x, double y) {
    aisle::Goal goal;
    goal.agv_id(agv);
    goal.goal_id(id);
    stamp(goal.by());
    goal.pose_in_map(wire::encode(geometry::Pose2{x, y, 0.0}));
    goal.position_tolerance_m(0.1);
    goals_.write(goal);
  }

  /// As a local planner that follows plans of this epoch.
  void say_followed(std::uint32_t epoch) {
    aisle::ServiceHealth health;
    health.instance_id(std::string("local-planner-agv-1"));
    stamp(health.by());
    aisle::Counter counter;
    counter.name(std::string("plan_epoch"));
    counter.value(epoch);
    health.counters().push_back(counter);
    healths_.write(health);
  }

  bool is_drivable_now(const aisle::Plan& sample) const {
    const auto plan = wire::decode(sample);
    if (!plan || plan->waypoints_in_map.empty()) return false;
    const grid::ClearanceField clearance(grid, 2.0);
    return is_drivable({clearance, plan->waypoints_in_map.front(), plan->waypoints_in_map.back(), kRadius_m},
                       plan->waypoints_in_map);
  }

  /// The vehicle says nothing any more.
  void fall_silent(const std::string& id) { poses_.erase(id); }

  bus::DdsBus bus;
  grid::OccupancyGrid grid;
  std::uint64_t revision{0};
  std::vector<aisle::Plan> plans;
  std::map<std::string, aisle::Grant> grants;  // the newest of each vehicle
  aisle::TrafficStatus traffic;                // the newest

 private:
  void stamp(aisle::Origin& by) { by = origin_.next(); }
  void publish_states() {
    for (const auto& [id, pose] : poses_) {
      aisle::VehicleState state;
      state.agv_id(id);
      stamp(state.by());
      state.base_in_map(wire::encode(pose));
      states_.write(state);
      publish_navigation(id);
    }
  }

  /// It stands before its first step, and gives back at once what it is asked for.
  void publish_navigation(const std::string& id) {
    aisle::NavigationStatus status;
    status.agv_id(id);
    stamp(status.by());
    status.traffic_epoch(obeyed_.epoch);
    status.traffic_boot_id(obeyed_.boot_id);
    const auto grant = grants.find(id);
    if (grant != grants.end()) {
      status.plan_id(grant->second.plan_id());
      status.grant_number(grant->second.number());
      status.grant_boot_id(grant->second.by().boot_id());
    }
    navigations_.write(status);
  }

  service::OriginStamper origin_{bus, "site", 1};
  bus::Writer<topics::MapInfo> infos_;
  bus::Writer<topics::MapTile> tiles_;
  bus::Writer<topics::MapZones> zones_;
  bus::Writer<topics::VehicleInfo> vehicles_;
  bus::Writer<topics::VehicleState> states_;
  bus::Writer<topics::Goal> goals_;
  bus::Writer<topics::NavigationStatus> navigations_;
  bus::Writer<topics::ServiceHealth> healths_;
  std::map<std::string, geometry::Pose2> poses_;
  fleet::Claim obeyed_;  // of the leaders that were heard
};

}  // namespace aisle::global_planner
