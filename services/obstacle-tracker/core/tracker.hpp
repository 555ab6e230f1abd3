#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/fleet/track.hpp"
#include "common/grid/clearance.hpp"
#include "services/obstacle-tracker/core/live_track.hpp"
#include "services/obstacle-tracker/core/scan.hpp"

namespace aisle::obstacle_tracker {

using fleet::Track;

/// The settings of all steps of the tracker.
struct TrackerParams {
  SensorNoise noise;
  Explained explained;
  Clustering clustering;
  Shape shape;
  MotionModel motion;
  Lifecycle lifecycle;

  template <class Reader>
  void describe(Reader& r) {
    r.section("noise", noise).section("explained", explained).section("clustering", clustering).section("shape", shape);
    r.section("motion", motion).section("lifecycle", lifecycle);
  }
};

/// What one scan did to the published tracks.
struct TakeResult {
  std::optional<DropReason> dropped;  // then nothing changed
  std::vector<std::uint64_t> seen;    // published, and measured by this scan
  std::vector<std::uint64_t> lost;    // published before, gone now
};

/// Turns the scans of all vehicles into one set of tracks: one track for each real obstacle, whichever lidars see it.
///
/// How: a scan is processed whole. Hits that the map or a vehicle of the fleet explains are removed; the others are
/// clustered; each cluster becomes a disc (detection); detections are assigned to tracks by least total Mahalanobis
/// distance; each track's filter is updated. Scans of several vehicles may come slightly out of order: a late one is
/// compared with the tracks' states at its own moment.
///
///   born ──2 scans──► published ──3 s in one place──► static
///     │                  │  ▲ seen again                 │
///     └─ not seen        └──┴─ unseen: carried on ───────┴──► lost: looked through, merged, overdue, or inside a wall
///
/// Reads no clock and holds no threads: moments come with the scans and with `now`, all on one clock. Its own time only
/// moves forward.
class Tracker {
 public:
  /// Ids count from `first_id`: a restarted tracker starts from another one, so that its ids are not taken for those
  /// given before the restart.
  explicit Tracker(const TrackerParams& params = {}, std::uint64_t first_id = 1);

  /// Takes one scan whole, or drops it and changes nothing but a counter.
  /// @param vehicles those that vehicle_info introduced, with their newest state; the scanning one must be among them
  /// @param clearance of the newest complete map; nullptr: there is none yet, the scan is dropped
  /// @param now for scans that are too old, or from the future
  [[nodiscard]] TakeResult take(const Scan& scan, const std::vector<KnownVehicle>& vehicles,
                                const grid::ClearanceField* clearance, time::Stamp now);

  /// Drops tracks past their timeout, for when no scans come. Returns the ids that were published and are gone.
  [[nodiscard]] std::vector<std::uint64_t> give_up_overdue(time::Stamp now);

  /// The published tracks, as of the newest scan, by id. `age_s` and `unseen_s` are as of `now`.
  std::vector<Track> tracks(time::Stamp now) const;

  /// How many tracks there are, published or not, and of how many vehicles a scan is remembered.
  std::size_t tracks_held() const { return live_.size(); }
  std::size_t vehicles_held() const { return sensors_.size(); }

  /// Counters since the start; dropped ones of all reasons, or of one.
  std::uint64_t scans_used() const { return scans_used_; }
  std::uint64_t scans_dropped() const;
  std::uint64_t scans_dropped(DropReason reason) const { return dropped_[static_cast<std::size_t>(reason)]; }

  /// Counts a scan that was refused before it came here (by ScanClock).
  void count_dropped(DropReason reason) { ++dropped_[static_cast<std::size_t>(reason)]; }

 private:
  /// The usual number of rays in a vehicle's scans, to notice a scan that was cut short.
  struct Sensor {
    time::Stamp newest{};
    std::size_t rays{0};
    std::size_t other_rays{0};
    int other_times{0};
  };

  /// Which detection is of which track.
  struct Matching {
    std::vector<int> track_of;     // for each detection the index in live_, or -1
    std::vector<char> is_matched;  // one a track
  };

  /// Checks a scan, and notes its stamp when it is usable.
  std::optional<DropReason> why_drop(const Scan& scan, const std::vector<KnownVehicle>& vehicles,
                                     const grid::ClearanceField* clearance, time::Stamp now);

  /// Forgets the scans of vehicles that are not among these.
  void forget_who_left(const std::vector<KnownVehicle>& vehicles);
  bool has_usual_count(Sensor& sensor, std::size_t rays) const;

  /// Predicts all tracks, to the moment of the scan's last ray; late scans move nothing.
  void move_on(time::Stamp to);

  /// Where the confirmed tracks were, or will be, at that moment.
  std::vector<Expected> expected_at(time::Stamp moment) const;

  /// Assigns detections to tracks by least total cost.
  Matching match(const std::vector<Detection>& detections, const Scan& scan) const;

  /// Aligns the detections with the confirmed tracks that they were matched with.
  void take_out_pose_error(std::vector<Detection>& detections, const Matching& matching, const Scan& scan,
                           const SortedScan& sorted) const;

  /// Updates matched tracks; begins a track for each detection that is neither matched nor part of a known thing.
  void take_in(const std::vector<Detection>& detections, const Scan& scan, Matching& matching, TakeResult& result);
  bool is_part_of_known(const Detection& detection, time::Stamp measured, Matching& matching);

  /// Tells the tracks that no detection was matched with whether the scan's rays went through them.
  void look_for_unmatched(const Scan& scan, const SortedScan& sorted, const Matching& matching);

  /// Of two tracks of one obstacle the younger is dropped, unless only that one is confirmed.
  void merge_doubles(const std::vector<Detection>& detections, const Matching& matching);

  /// Removes the tracks for which `is_gone` is true; adds the ids of the published ones to `lost`.
  template <class IsGone>
  void bury(IsGone is_gone, std::vector<std::uint64_t>& lost);

  TrackerParams params_;
  std::uint64_t next_id_;
  time::Stamp moment_{};         // of every track's state: the newest scan's last ray
  std::vector<LiveTrack> live_;  // oldest first
  std::map<std::string, Sensor> sensors_;
  std::uint64_t scans_used_{0};
  std::array<std::uint64_t, kDropReasons> dropped_{};
};

}  // namespace aisle::obstacle_tracker
