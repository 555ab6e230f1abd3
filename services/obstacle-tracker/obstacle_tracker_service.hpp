#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/process/log.hpp"
#include "common/service/map_client.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/service/shell.hpp"
#include "common/wire/checks.hpp"
#include "services/obstacle-tracker/core/coverage.hpp"
#include "services/obstacle-tracker/core/outbox.hpp"
#include "services/obstacle-tracker/core/scan_clock.hpp"
#include "services/obstacle-tracker/core/tracker.hpp"

namespace aisle::obstacle_tracker {

/// Everything that a site may set.
struct ServiceParams {
  TrackerParams tracker;
  Coverage::Params coverage;
  std::string only_scans_of;  // the one vehicle whose scans are used, for a tracker a vehicle; empty: all

  template <class Reader>
  void describe(Reader& r) {
    tracker.describe(r);
    r.section("coverage", coverage).field("only_scans_of", only_scans_of);
  }
};

/// Between the bus and the tracker: each scan is taken, and its tracks written, in the handler that gets it.
class ObstacleTrackerService {
 public:
  ObstacleTrackerService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id, service::Health& health,
                         const ServiceParams& params);
  ObstacleTrackerService(const ObstacleTrackerService&) = delete;
  ObstacleTrackerService& operator=(const ObstacleTrackerService&) = delete;

 private:
  /// A vehicle that vehicle_info made known.
  struct VehicleEntry {
    KnownVehicle known;
    bool has_state{false};
    ScanClock scan_clock;
    std::uint64_t scan_sequence{0};  // of the newest scan used; 0: none
    std::int64_t scan_stamp_ns{0};
  };

  void listen();
  void hear(const aisle::VehicleInfo& sample);
  void hear(const aisle::VehicleState& sample, time::Stamp arrived);
  void hear(const aisle::Scan& sample, time::Stamp arrived);
  void refuse(DropReason reason, const std::string& agv_id);
  void tell_dropped(DropReason reason, const std::string& agv_id);
  void write_tracks(const std::vector<std::uint64_t>& seen, time::Stamp now);
  void dispose(const std::vector<std::uint64_t>& lost);
  void write_status(time::Stamp now, time::Stamp took);
  void write_coverage();
  void dispose_coverage(std::uint32_t tile_x, std::uint32_t tile_y);
  void tend();
  void report();
  std::vector<KnownVehicle> known_vehicles() const;
  /// Nothing when the sample must be dropped, which is counted and said.
  template <class T>
  std::optional<T> accepted(const char* topic, wire::Decoded<T> decoded);

  bus::Bus& bus_;
  service::Health& health_;
  service::OriginStamper track_stamper_;
  service::OriginStamper status_stamper_;
  service::OriginStamper coverage_stamper_;
  std::string instance_id_;
  std::string only_scans_of_;
  service::MapClient map_;
  Tracker tracker_;
  Outbox outbox_;
  Coverage coverage_;
  std::map<std::string, VehicleEntry> vehicles_;
  bus::Writer<topics::Track> tracks_;
  bus::Writer<topics::TrackingStatus> statuses_;
  bus::Writer<topics::Coverage> coverages_;
  std::int64_t newest_scan_stamp_ns_{0};  // of any vehicle, by its own clock
  time::Stamp newest_scan_used_{};        // by ours
  process::LimitedWarnings warnings_;
};

}  // namespace aisle::obstacle_tracker
