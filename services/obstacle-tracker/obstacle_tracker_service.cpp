#include "services/obstacle-tracker/obstacle_tracker_service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "common/wire/origin.hpp"
#include "common/wire/tracking.hpp"
#include "common/wire/vehicle.hpp"

namespace aisle::obstacle_tracker {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using std::chrono::milliseconds;

constexpr milliseconds kTend{100};
constexpr milliseconds kReport{250};
constexpr milliseconds kTellCoverage{1000};
constexpr std::size_t kMostVehicles = 256;  // as many as tracking_status can tell of
constexpr std::size_t kMostTracks = 1024;
constexpr double kWallsReach_m = 2.0;  // farther from a wall than this nothing depends on how far
constexpr double kScansMissing_s = 1.0;

/// Ids of a boot begin where those of an earlier one cannot be, and stay exact in JSON (below 2^53).
std::uint64_t first_id(std::uint64_t boot_id_us) { return boot_id_us / 1000 % 10'000'000'000ULL * 100'000 + 1; }

}  // namespace

ObstacleTrackerService::ObstacleTrackerService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id,
                                               service::Health& health, const ServiceParams& params)
    : bus_(bus),
      health_(health),
      track_stamper_(bus, instance_id, boot_id),
      status_stamper_(bus, instance_id, boot_id),
      coverage_stamper_(bus, instance_id, boot_id),
      instance_id_(instance_id),
      only_scans_of_(params.only_scans_of),
      map_(bus, instance_id, {{}, true, kWallsReach_m, milliseconds(300)}),
      tracker_(params.tracker, first_id(boot_id)),
      coverage_(params.coverage),
      tracks_(bus.writer<topics::Track>()),
      statuses_(bus.writer<topics::TrackingStatus>()),
      coverages_(bus.writer<topics::Coverage>()),
      warnings_(std::chrono::seconds(10), [&bus] { return bus.now(); }) {
  listen();
  bus_.every(kTend, [this] { tend(); });
  bus_.every(kReport, [this] { report(); });
  bus_.every(kTellCoverage, [this] { write_coverage(); });
}

template <class T>
std::optional<T> ObstacleTrackerService::accepted(const char* topic, wire::Decoded<T> decoded) {
  if (decoded) return *std::move(decoded);
  health_.count(std::string("dropped_") + topic);
  warnings_.warn(topic, std::string(topic) + ": a sample was dropped: " + decoded.reason());
  return std::nullopt;
}

void ObstacleTrackerService::listen() {
  // A vehicle that is gone from the bus may still stand where it was: only data changes what is known of it.
  map_.on_map([this](const grid::OccupancyGrid& grid, const grid::ClearanceField&, grid::Cell, grid::Cell) {
    for (const auto& [tile_x, tile_y] : coverage_.set_ground(grid.geometry())) dispose_coverage(tile_x, tile_y);
  });
  bus_.on<topics::VehicleInfo>([this](const aisle::VehicleInfo& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) hear(sample);
  });
  bus_.on<topics::VehicleState>([this](const aisle::VehicleState& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) hear(sample, info.arrived);
  });
  bus_.on<topics::Scan>([this](const aisle::Scan& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) hear(sample, info.arrived);
  });
}

void ObstacleTrackerService::hear(const aisle::VehicleInfo& sample) {
  const auto vehicle = accepted("vehicle_info", wire::decode(sample));
  if (!vehicle) return;
  if (vehicles_.count(vehicle->id) == 0 && vehicles_.size() >= kMostVehicles) {
    warnings_.warn("vehicles", "vehicle_info of " + vehicle->id + " is not used: there are " +
                                   std::to_string(kMostVehicles) + " vehicles already");
    return;
  }
  KnownVehicle& known = vehicles_[vehicle->id].known;
  known.agv_id = vehicle->id;
  known.is_rectangle = !vehicle->footprint.is_disc();
  known.radius_m = vehicle->reach_m();
  known.length_m = vehicle->footprint.length_m;
  known.width_m = vehicle->footprint.width_m;
  known.ahead_m = vehicle->footprint.ahead_m;
}

void ObstacleTrackerService::hear(const aisle::VehicleState& sample, time::Stamp arrived) {
  const auto state = accepted("vehicle_state", wire::decode(sample));
  if (!state) return;
  const auto found = vehicles_.find(state->agv_id);
  if (found == vehicles_.end()) return;
  found->second.known.base_in_map = state->motion.base_in_map;
  found->second.known.twist = state->motion.twist;
  found->second.known.stamp = arrived;
  found->second.has_state = true;
}

void ObstacleTrackerService::hear(const aisle::Scan& sample, time::Stamp arrived) {
  const time::Stamp begun = bus_.now();
  auto decoded = accepted("scan", wire::decode(sample));
  if (!decoded || (!only_scans_of_.empty() && decoded->agv_id != only_scans_of_)) return;
  const fleet::Origin by = wire::origin_of(sample);
  Scan scan{*std::move(decoded), {}};
  const auto found = vehicles_.find(scan.agv_id);
  if (found == vehicles_.end()) return refuse(DropReason::kUnknownVehicle, scan.agv_id);
  VehicleEntry& vehicle = found->second;
  const auto placed = vehicle.scan_clock.place(by.stamp_ns, arrived);
  if (const auto* reason = std::get_if<DropReason>(&placed)) return refuse(*reason, scan.agv_id);
  scan.stamp = std::get<time::Stamp>(placed);
  const TakeResult result = tracker_.take(scan, known_vehicles(), map_.has_map() ? &map_.clearance() : nullptr, begun);
  if (result.dropped) return tell_dropped(*result.dropped, scan.agv_id);

  vehicle.scan_sequence = by.sequence_number;
  vehicle.scan_stamp_ns = by.stamp_ns;
  newest_scan_stamp_ns_ = by.stamp_ns;
  newest_scan_used_ = begun;
  coverage_.take(scan);
  dispose(result.lost);
  write_tracks(result.seen, begun);
  write_status(begun, bus_.now() - begun);
}

void ObstacleTrackerService::refuse(DropReason reason, const std::string& agv_id) {
  tracker_.count_dropped(reason);
  tell_dropped(reason, agv_id);
}

void ObstacleTrackerService::tell_dropped(DropReason reason, const std::string& agv_id) {
  health_.count(std::string("scans_") + name_of(reason));
  if (reason == DropReason::kNoMap) return;  // service_health says what is waited for
  warnings_.warn(name_of(reason), "a scan of " + agv_id + " was dropped: " + explain(reason));
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
    aisle::Track sample = wire::encode(track);
    sample.by(track_stamper_.next());
    if (!tracks_.write(sample)) health_.count("tracks_not_written");
  }
}

void ObstacleTrackerService::dispose(const std::vector<std::uint64_t>& lost) {
  for (const std::uint64_t id : lost) {
    aisle::Track sample;
    sample.track_id(id);
    tracks_.dispose(sample);
    outbox_.forget(id);
  }
}

void ObstacleTrackerService::write_status(time::Stamp now, time::Stamp took) {
  fleet::TrackingStatus status;
  status.source_id = instance_id_;
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
  aisle::TrackingStatus sample = wire::encode(status);
  sample.by(status_stamper_.next());
  statuses_.write(sample);
}

void ObstacleTrackerService::write_coverage() {
  for (CoverageTile tile : coverage_.due(bus_.now())) {
    tile.source_id = instance_id_;
    tile.map_id = map_.map_id();
    aisle::Coverage sample = wire::encode(tile);
    sample.by(coverage_stamper_.next());
    if (!coverages_.write(sample)) health_.count("coverage_not_written");
  }
}

void ObstacleTrackerService::dispose_coverage(std::uint32_t tile_x, std::uint32_t tile_y) {
  aisle::Coverage sample;
  sample.source_id(instance_id_);
  sample.tile_x(tile_x);
  sample.tile_y(tile_y);
  coverages_.dispose(sample);
}

/// When no scans come, what is overdue goes. No status then: who is blind must not be taken for one who sees nothing.
void ObstacleTrackerService::tend() {
  const time::Stamp now = bus_.now();
  if (now - newest_scan_used_ < kTend) return;
  dispose(tracker_.give_up_overdue(now));
  write_tracks({}, now);
}

void ObstacleTrackerService::report() {
  const time::Stamp now = bus_.now();
  health_.map_id = map_.map_id();
  health_.map_revision = map_.revision();
  health_.map_hash = map_.hash();
  health_.counters["scans_used"] = tracker_.scans_used();
  health_.counters["scans_dropped"] = tracker_.scans_dropped();
  health_.counters["tracks"] = tracker_.tracks(now).size();
  std::string waits_for;
  if (!map_.has_map()) waits_for = "map_info, map_tile";
  if (vehicles_.empty()) waits_for += std::string(waits_for.empty() ? "" : ", ") + "vehicle_info";
  if (newest_scan_used_ == time::Stamp{} || time::seconds(now - newest_scan_used_) > kScansMissing_s) {
    waits_for += std::string(waits_for.empty() ? "" : ", ") + "scan";
  }
  health_.waits_for = waits_for;
  health_.state = waits_for.empty() ? fleet::ServiceState::kReady : fleet::ServiceState::kWaiting;
}

}  // namespace aisle::obstacle_tracker
