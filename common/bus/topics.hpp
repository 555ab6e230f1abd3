#pragma once

// The one table of topics: name, type and QoS. Every reader and writer is made from it; docs/topics.md is printed from
// it. key() refers to the key fields of a sample: `Topic::key(copy) = Topic::key(sample)`.

#include <chrono>
#include <tuple>

#include "common/bus/qos.hpp"
#include "idl/map.hpp"
#include "idl/planning.hpp"
#include "idl/service.hpp"
#include "idl/tracking.hpp"
#include "idl/traffic.hpp"
#include "idl/vehicle.hpp"

namespace aisle::topics {

using bus::Durability;
using bus::Ownership;
using bus::Qos;
using bus::Reliability;
using std::chrono::milliseconds;

/// QoS that several topics share. Stream: only the newest sample counts, losses are not repaired.
/// State: late joiners get the last value. Queue: every sample arrives, none is replaced.
inline constexpr Qos kStream{Reliability::kBestEffort, Durability::kVolatile, 1, 0, milliseconds{0},
                             Ownership::kShared,       milliseconds{0}};
inline constexpr Qos kState{
    Reliability::kReliable, Durability::kTransientLocal, 1, 0, milliseconds{0}, Ownership::kShared, milliseconds{0}};
inline constexpr Qos kQueue{Reliability::kReliable, Durability::kVolatile, 0, 1024, milliseconds{0},
                            Ownership::kShared,     milliseconds{0}};

struct MapInfo {
  using Sample = aisle::MapInfo;

  static constexpr const char* kName = "map_info";
  static constexpr const char* kKey = "map_id";
  static auto key(Sample& sample) { return std::tie(sample.map_id()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "late joiners get the newest revision and the hashes that tiles must have";
};

struct MapTile {
  using Sample = aisle::MapTile;

  static constexpr const char* kName = "map_tile";
  static constexpr const char* kKey = "map_id, tile_x, tile_y";
  static auto key(Sample& sample) { return std::tie(sample.map_id(), sample.tile_x(), sample.tile_y()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "an edit resends the tiles it changed, never the map";
};

struct MapRequest {
  using Sample = aisle::MapRequest;

  static constexpr const char* kName = "map_request";
  static constexpr const char* kKey = "requester_id";
  static auto key(Sample& sample) { return std::tie(sample.requester_id()); }
  static constexpr Qos kQos = kQueue;
  static constexpr const char* kWhy = "a mirror asks again for tiles that it misses";
};

struct MapEdit {
  using Sample = aisle::MapEdit;

  static constexpr const char* kName = "map_edit";
  static constexpr const char* kKey = "edit_id";
  static auto key(Sample& sample) { return std::tie(sample.edit_id()); }
  static constexpr Qos kQos = kQueue;
  static constexpr const char* kWhy = "each edit counts; it is applied once, or refused with a reason";
};

struct MapEditResult {
  using Sample = aisle::MapEditResult;

  static constexpr const char* kName = "map_edit_result";
  static constexpr const char* kKey = "edit_id";
  static auto key(Sample& sample) { return std::tie(sample.edit_id()); }
  static constexpr Qos kQos = kQueue;
  static constexpr const char* kWhy = "the answer to each edit";
};

struct ZoneEdit {
  using Sample = aisle::ZoneEdit;

  static constexpr const char* kName = "zone_edit";
  static constexpr const char* kKey = "edit_id";
  static auto key(Sample& sample) { return std::tie(sample.edit_id()); }
  static constexpr Qos kQos = kQueue;
  static constexpr const char* kWhy = "each edit of a zone counts; it is answered by map_edit_result";
};

struct MapZones {
  using Sample = aisle::MapZones;

  static constexpr const char* kName = "map_zones";
  static constexpr const char* kKey = "map_id";
  static auto key(Sample& sample) { return std::tie(sample.map_id()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "all zones of the map, written again when one changes; late joiners get them";
};

struct VehicleInfo {
  using Sample = aisle::VehicleInfo;

  static constexpr const char* kName = "vehicle_info";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "footprint, model, limits and sensor, for late joiners too";
};

struct VehicleState {
  using Sample = aisle::VehicleState;

  static constexpr const char* kName = "vehicle_state";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos{Reliability::kBestEffort, Durability::kVolatile, 1, 0, milliseconds{200},
                            Ownership::kShared,       milliseconds{0}};
  static constexpr const char* kWhy = "only the newest matters";
};

struct Scan {
  using Sample = aisle::Scan;

  static constexpr const char* kName = "scan";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos = kStream;
  static constexpr const char* kWhy = "sensor data";
};

struct Goal {
  using Sample = aisle::Goal;

  static constexpr const char* kName = "goal";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "a planner that restarts finds the open goals";
};

struct Plan {
  using Sample = aisle::Plan;

  static constexpr const char* kName = "plan";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos{
      Reliability::kReliable, Durability::kTransientLocal, 1, 0, milliseconds{0}, Ownership::kExclusive,
      milliseconds{200}};
  static constexpr const char* kWhy = "one planner is heard; a standby takes over within the lease";
};

struct Grant {
  using Sample = aisle::Grant;

  static constexpr const char* kName = "grant";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos = Plan::kQos;
  static constexpr const char* kWhy = "how far a vehicle may drive; authority changes hands with that of the plan";
};

struct TrafficStatus {
  using Sample = aisle::TrafficStatus;

  static constexpr const char* kName = "traffic_status";
  static constexpr const char* kKey = "source_id";
  static auto key(Sample& sample) { return std::tie(sample.source_id()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "10 Hz: the leader's beat, and which vehicle waits for which, since when and why";
};

struct SignOff {
  using Sample = aisle::SignOff;

  static constexpr const char* kName = "sign_off";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos{Reliability::kReliable, Durability::kVolatile, 1, 0, milliseconds{0},
                            Ownership::kShared,     milliseconds{0}};
  static constexpr const char* kWhy = "a person's word, now, that a silent vehicle drives no more";
};

struct Track {
  using Sample = aisle::Track;

  static constexpr const char* kName = "track";
  static constexpr const char* kKey = "track_id";
  static auto key(Sample& sample) { return std::tie(sample.track_id()); }
  static constexpr Qos kQos{Reliability::kReliable, Durability::kVolatile, 1, 0, milliseconds{0},
                            Ownership::kShared,     milliseconds{0}};
  static constexpr const char* kWhy = "disposed when lost";
};

struct TrackingStatus {
  using Sample = aisle::TrackingStatus;

  static constexpr const char* kName = "tracking_status";
  static constexpr const char* kKey = "source_id";
  static auto key(Sample& sample) { return std::tie(sample.source_id()); }
  static constexpr Qos kQos = kStream;
  static constexpr const char* kWhy = "tells no obstacle from no tracker, and which scans are in the tracks";
};

struct Coverage {
  using Sample = aisle::Coverage;

  static constexpr const char* kName = "coverage";
  static constexpr const char* kKey = "source_id, tile_x, tile_y";
  static auto key(Sample& sample) { return std::tie(sample.source_id(), sample.tile_x(), sample.tile_y()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "1 Hz: where the fleet looked, and when; late joiners get what was seen before";
};

struct VelocityCommand {
  using Sample = aisle::VelocityCommand;

  static constexpr const char* kName = "velocity_command";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos{Reliability::kBestEffort, Durability::kVolatile, 1, 0, milliseconds{200},
                            Ownership::kExclusive,    milliseconds{200}};
  static constexpr const char* kWhy = "50 Hz; a late command is worse than none";
};

struct NavigationStatus {
  using Sample = aisle::NavigationStatus;

  static constexpr const char* kName = "navigation_status";
  static constexpr const char* kKey = "agv_id";
  static auto key(Sample& sample) { return std::tie(sample.agv_id()); }
  static constexpr Qos kQos = kState;
  static constexpr const char* kWhy = "phase, reason and intent, for planners, peers and people";
};

struct WorldObstacle {
  using Sample = aisle::WorldObstacle;

  static constexpr const char* kName = "world_obstacle";
  static constexpr const char* kKey = "obstacle_id";
  static auto key(Sample& sample) { return std::tie(sample.obstacle_id()); }
  static constexpr Qos kQos = kStream;
  static constexpr const char* kWhy = "ground truth, for simulated sensors and for the referee";
};

struct ServiceHealth {
  using Sample = aisle::ServiceHealth;

  static constexpr const char* kName = "service_health";
  static constexpr const char* kKey = "instance_id";
  static auto key(Sample& sample) { return std::tie(sample.instance_id()); }
  static constexpr Qos kQos{Reliability::kReliable, Durability::kTransientLocal, 1, 0, milliseconds{0},
                            Ownership::kShared,     milliseconds{2000}};
  static constexpr const char* kWhy = "hello: versions, ids, map hash, state, what it waits for, counters";
};

/// A list of types to fold over: `for_each(All{}, [](auto topic) { using Topic = decltype(topic); ... })`.
template <class... Topics>
struct List {};

using All = List<MapInfo, MapTile, MapRequest, MapEdit, MapEditResult, ZoneEdit, MapZones, VehicleInfo, VehicleState,
                 Scan, Goal, Plan, Grant, TrafficStatus, SignOff, Track, TrackingStatus, Coverage, VelocityCommand,
                 NavigationStatus, WorldObstacle, ServiceHealth>;

template <class... Topics, class Function>
void for_each(List<Topics...>, Function&& function) {
  (function(Topics{}), ...);
}

}  // namespace aisle::topics
