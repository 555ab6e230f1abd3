#include "services/obstacle-tracker/obstacle_tracker_service.hpp"

#include <chrono>
#include <utility>
#include <variant>

namespace aisle::obstacle_tracker {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTend{100};
constexpr milliseconds kTellCoverage{1000};
constexpr std::size_t kMostVehicles = 256;  // the bound of newest_scans in tracking_status
constexpr std::size_t kMostTracks = 1024;
constexpr double kWallsReach_m = 2.0;  // the clearance field is exact up to here; the tracker asks for no more
constexpr double kScansMissing_s = 1.0;

/// The first track id of this process: made of its start in milliseconds, so that ids of an earlier process are never
/// used again, and small enough to be exact in JSON (below 2^53).
std::uint64_t first_id(std::uint64_t boot_id_us) { return boot_id_us / 1000 % 10'000'000'000ULL * 100'000 + 1; }

}  // namespace

ObstacleTrackerService::ObstacleTrackerService(service::Shell& shell, const ServiceParams& params)
    : shell_(shell),
      only_scans_of_(params.only_scans_of),
      map_(shell.map({{}, true, kWallsReach_m, milliseconds(300)},
                     [this](const grid::OccupancyGrid& grid, const grid::ClearanceField&, grid::Cell, grid::Cell) {
                       set_ground(grid.geometry());
                     })),
      tracker_(params.tracker, first_id(shell.boot_id())),
      coverage_(params.coverage),
      tracks_(shell.outbox<topics::Track>()),
      statuses_(shell.outbox<topics::TrackingStatus>()),
      coverages_(shell.outbox<topics::Coverage>()) {
  // A vehicle that is gone from the bus may still stand where it was: only data changes what is known of it.
  shell.inbox<topics::VehicleInfo>([this](const fleet::Vehicle& vehicle) { hear(vehicle); });
  shell.inbox<topics::VehicleState>(
      [this](const fleet::VehicleState& state, const service::Sender& from) { hear(state, from.arrived); });
  shell.inbox<topics::Scan>([this](const fleet::Scan& scan, const service::Sender& from) { hear(scan, from); });

  shell.every(kTend, [this] { tend(); });
  shell.every(kTellCoverage, [this] { write_coverage(); });

  shell.report([this](service::Health& health) { report(health); });
}

void ObstacleTrackerService::hear(const fleet::Vehicle& vehicle) {
  if (vehicles_.count(vehicle.id) == 0 && vehicles_.size() >= kMostVehicles) {
    shell_.warn("vehicles", "vehicle_info of " + vehicle.id + " is not used: there are " +
                                std::to_string(kMostVehicles) + " vehicles already");
    return;
  }

  KnownVehicle& known = vehicles_[vehicle.id].known;
  known.agv_id = vehicle.id;

  known.is_rectangle = !vehicle.footprint.is_disc();
  known.radius_m = vehicle.reach_m();
  known.length_m = vehicle.footprint.length_m;
  known.width_m = vehicle.footprint.width_m;
  known.ahead_m = vehicle.footprint.ahead_m;
}

void ObstacleTrackerService::hear(const fleet::VehicleState& state, time::Stamp arrived) {
  const auto found = vehicles_.find(state.agv_id);
  if (found == vehicles_.end()) return;

  found->second.known.base_in_map = state.motion.base_in_map;
  found->second.known.twist = state.motion.twist;
  found->second.known.stamp = arrived;
  found->second.has_state = true;
}

void ObstacleTrackerService::hear(const fleet::Scan& heard, const service::Sender& from) {
  if (!only_scans_of_.empty() && heard.agv_id != only_scans_of_) return;

  // Place the scan in time, by its own clock; what comes late or twice is dropped.
  const time::Stamp begun = shell_.now();
  Scan scan{heard, {}};

  const auto found = vehicles_.find(scan.agv_id);
  if (found == vehicles_.end()) return refuse(DropReason::kUnknownVehicle, scan.agv_id);

  VehicleEntry& vehicle = found->second;
  const auto placed = vehicle.scan_clock.place(from.by.stamp_ns, from.arrived);
  if (const auto* reason = std::get_if<DropReason>(&placed)) return refuse(*reason, scan.agv_id);

  scan.stamp = std::get<time::Stamp>(placed);

  // The tracks of this moment.
  const TakeResult result = tracker_.take(scan, known_vehicles(), map_.has_map() ? &map_.clearance() : nullptr, begun);
  if (result.dropped) return tell_dropped(*result.dropped, scan.agv_id);

  vehicle.scan_sequence = from.by.sequence_number;
  vehicle.scan_stamp_ns = from.by.stamp_ns;
  newest_scan_stamp_ns_ = from.by.stamp_ns;
  newest_scan_used_ = begun;

  // What the scan saw is free, then the tracks that went, then those that changed, then the status that names the scan.
  coverage_.take(scan);
  dispose(result.lost);
  write_tracks(result.seen, begun);
  write_status(begun, shell_.now() - begun);
}

void ObstacleTrackerService::refuse(DropReason reason, const std::string& agv_id) {
  tracker_.count_dropped(reason);
  tell_dropped(reason, agv_id);
}

void ObstacleTrackerService::tell_dropped(DropReason reason, const std::string& agv_id) {
  shell_.count(std::string("scans_") + name_of(reason));

  if (reason == DropReason::kNoMap) return;  // service_health says what is waited for
  shell_.warn(name_of(reason), "a scan of " + agv_id + " was dropped: " + explain(reason));
}

std::vector<KnownVehicle> ObstacleTrackerService::known_vehicles() const {
  std::vector<KnownVehicle> known;
  known.reserve(vehicles_.size());

  for (const auto& [id, vehicle] : vehicles_) {
    known.push_back(vehicle.known);
    if (!vehicle.has_state)
      known.back().stamp = time::Stamp::min() / 2;  // nobody knows where it is: it explains nothing
  }

  return known;
}

void ObstacleTrackerService::write_tracks(const std::vector<std::uint64_t>& seen, time::Stamp now) {
  for (Track track : outbox_.due(tracker_.tracks(now), seen, now)) {
    track.scan_stamp_ns = newest_scan_stamp_ns_;
    if (change_told_) change_told_(track);
    tracks_.write(track);
  }
}

void ObstacleTrackerService::dispose(const std::vector<std::uint64_t>& lost) {
  for (const std::uint64_t id : lost) {
    tracks_.dispose(id);
    outbox_.forget(id);
  }
}

void ObstacleTrackerService::write_status(time::Stamp now, time::Stamp took) {
  fleet::TrackingStatus status;
  status.source_id = shell_.instance_id();

  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle.scan_sequence == 0) continue;
    status.newest_scans.push_back({id, vehicle.scan_sequence, vehicle.scan_stamp_ns});
  }

  for (const Track& track : tracker_.tracks(now)) {
    if (status.live_track_ids.size() < kMostTracks) status.live_track_ids.push_back(track.id);
  }

  status.scans_used = tracker_.scans_used();
  status.scans_dropped = tracker_.scans_dropped();
  status.processing_ms = 1e3 * time::seconds(took);

  statuses_.write(status);
}

void ObstacleTrackerService::write_coverage() {
  for (CoverageTile tile : coverage_.due(shell_.now())) {
    tile.source_id = shell_.instance_id();
    tile.map_id = map_.map_id();
    coverages_.write(tile);
  }
}

void ObstacleTrackerService::set_ground(const grid::Geometry& geometry) {
  for (const auto& [tile_x, tile_y] : coverage_.set_ground(geometry))
    coverages_.dispose({shell_.instance_id(), tile_x, tile_y});
}

/// When no scans come, tracks that are overdue are given up. No status is written then: a consumer must not take a
/// tracker without scans for one that sees an empty floor.
void ObstacleTrackerService::tend() {
  const time::Stamp now = shell_.now();
  if (now - newest_scan_used_ < kTend) return;

  dispose(tracker_.give_up_overdue(now));
  write_tracks({}, now);
}

void ObstacleTrackerService::report(service::Health& health) const {
  const time::Stamp now = shell_.now();
  health.counters["scans_used"] = tracker_.scans_used();
  health.counters["scans_dropped"] = tracker_.scans_dropped();
  health.counters["tracks"] = tracker_.tracks(now).size();

  if (!map_.has_map()) health.wait_for("map_info, map_tile");
  if (vehicles_.empty()) health.wait_for("vehicle_info");
  if (newest_scan_used_ == time::Stamp{} || time::seconds(now - newest_scan_used_) > kScansMissing_s)
    health.wait_for("scan");
}

}  // namespace aisle::obstacle_tracker
