#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/service/shell.hpp"
#include "services/obstacle-tracker/core/coverage.hpp"
#include "services/obstacle-tracker/core/outbox.hpp"
#include "services/obstacle-tracker/core/scan_clock.hpp"
#include "services/obstacle-tracker/core/tracker.hpp"

namespace aisle::obstacle_tracker {

/// What the process takes from its config file.
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

/// Turns the scans of all vehicles into one set of tracks. Each scan is taken, and its tracks are written, in the
/// handler that gets it; once a second it writes which part of the floor was seen (`coverage`). Scans of vehicles that
/// `vehicle_info` has not introduced are dropped, as are all scans before the map is there. Runs in the shell's loop.
class ObstacleTrackerService {
 public:
  /// Registers topics and timers with `shell`, which must outlive this object.
  ObstacleTrackerService(service::Shell& shell, const ServiceParams& params);
  ObstacleTrackerService(const ObstacleTrackerService&) = delete;
  ObstacleTrackerService& operator=(const ObstacleTrackerService&) = delete;

  /// Each track passes through `change` before it is written: for experiments that run this service in
  /// their own process, e.g. on what a track's velocity is worth to a planner.
  void tell_through(std::function<void(fleet::Track&)> change) { change_told_ = std::move(change); }

 private:
  /// A vehicle which vehicle_info introduced, and the newest of its scans that was used.
  struct VehicleEntry {
    KnownVehicle known;
    bool has_state{false};
    ScanClock scan_clock;
    std::uint64_t scan_sequence{0};  // of the newest scan used; 0: none
    std::int64_t scan_stamp_ns{0};
  };

  /// Outline of a vehicle; at most 256 vehicles are used.
  void hear(const fleet::Vehicle& vehicle);

  /// Where the vehicle is, by its own word: its body explains echoes.
  void hear(const fleet::VehicleState& state, time::Stamp arrived);

  /// Takes a scan and writes what follows from it, or drops it for one of the DropReasons.
  void hear(const fleet::Scan& scan, const service::Sender& from);

  /// Counts a scan that did not get as far as the tracker, and tells it.
  void refuse(DropReason reason, const std::string& agv_id);

  /// Counter and warning of a dropped scan.
  void tell_dropped(DropReason reason, const std::string& agv_id);

  /// Writes those tracks of which the outbox says that it is time. `seen`: ids that this scan has confirmed.
  void write_tracks(const std::vector<std::uint64_t>& seen, time::Stamp now);

  /// Ends the instances of lost tracks.
  void dispose(const std::vector<std::uint64_t>& lost);

  /// Newest scan of each vehicle, live tracks and counters. `took`: time spent on the scan.
  void write_status(time::Stamp now, time::Stamp took);

  /// Writes the coverage tiles that are due.
  void write_coverage();

  /// The map has another extent: coverage begins anew and its old tiles end.
  void set_ground(const grid::Geometry& geometry);

  /// Gives up overdue tracks when no scans come.
  void tend();

  /// Counters, and what is waited for.
  void report(service::Health& health) const;

  /// All vehicles for the tracker; one whose state was never heard gets a stamp so old that it explains nothing.
  std::vector<KnownVehicle> known_vehicles() const;

  service::Shell& shell_;
  std::string only_scans_of_;
  service::MapClient& map_;
  Tracker tracker_;
  Outbox outbox_;
  Coverage coverage_;
  std::map<std::string, VehicleEntry> vehicles_;

  service::Outbox<topics::Track> tracks_;
  std::function<void(fleet::Track&)> change_told_;  // may be empty
  service::Outbox<topics::TrackingStatus> statuses_;
  service::Outbox<topics::Coverage> coverages_;
  std::int64_t newest_scan_stamp_ns_{0};  // of any vehicle, by its own clock
  time::Stamp newest_scan_used_{};        // by ours
};

}  // namespace aisle::obstacle_tracker
