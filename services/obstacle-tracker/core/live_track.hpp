#pragma once

#include <cstdint>
#include <memory>

#include "common/fleet/track.hpp"
#include "common/time/stamp.hpp"
#include "services/obstacle-tracker/core/detections.hpp"
#include "services/obstacle-tracker/core/motion_filter.hpp"

namespace aisle::obstacle_tracker {

using fleet::Track;

/// Thresholds of a track's life: start, confirm, keep, drop.
struct Lifecycle {
  double gate{13.8};           // squared Mahalanobis distance within which a detection may be a track's (99.9 %)
  double gate_speed_mps{5.0};  // an obstacle may turn round at once: the gate is no narrower than this speed reaches
  double turn_gate{9.2};       // beyond it (99 %) it turned or started: its velocity's covariance is increased
  double turn_speed_sigma_mps{0.3};  // by this; with more, one outlier in a hundred spoils the velocity
  int confirming_scans{2};           // scans that must show it before it is published
  int confirming_rays{3};            // and rays in all, of which at most two of each scan count
  double unconfirmed_timeout_s{0.5};
  double unseen_timeout_s{2.0};   // of an obstacle that moved when last seen; at most as long as it had been seen
  double static_timeout_s{30.0};  // of one that stood: it is kept while no lidar looks there
  int free_scans{2};              // dropped after so many scans in a row with rays through its position
  double static_after_s{3.0};
  double static_reach_m{0.25};  // it stands while it stays this near to where it was
  double merge_m{0.28};         // two tracks nearer than this are one
  double max_radius_m{1.5};

  // Squared Mahalanobis distance within which a track helps to estimate the error of the vehicle's pose; 0: none does.
  double mark_gate{6.0};

  template <class Reader>
  void describe(Reader& r) {
    r.field("gate", gate, 1.0, 100.0)
        .field("gate_speed_mps", gate_speed_mps, 0.0, 20.0)
        .field("turn_gate", turn_gate, 1.0, 100.0)
        .field("turn_speed_sigma_mps", turn_speed_sigma_mps, 0.0, 10.0)
        .field("confirming_scans", confirming_scans, 1, 20)
        .field("confirming_rays", confirming_rays, 1, 40)
        .field("unconfirmed_timeout_s", unconfirmed_timeout_s, 0.05, 10.0)
        .field("unseen_timeout_s", unseen_timeout_s, 0.1, 60.0)
        .field("static_timeout_s", static_timeout_s, 0.1, 3600.0)
        .field("free_scans", free_scans, 1, 100)
        .field("static_after_s", static_after_s, 0.1, 60.0)
        .field("static_reach_m", static_reach_m, 0.01, 2.0)
        .field("merge_m", merge_m, 0.0, 2.0)
        .field("max_radius_m", max_radius_m, 0.1, 10.0)
        .field("mark_gate", mark_gate, 0.0, 100.0);
  }
};

/// A track from its first detection until it is dropped, published or not. Moments are on the tracker's clock;
/// positions are in map.
class LiveTrack {
 public:
  /// A thing just found. `moment`: when the detection was measured, and the moment of the state.
  LiveTrack(std::uint64_t id, const Detection& detection, const MotionModel& motion, time::Stamp moment);

  /// As published; never given twice.
  std::uint64_t id() const { return id_; }
  const MotionFilter& filter() const { return *filter_; }
  double radius_m() const { return radius_m_; }
  bool is_static() const { return is_static_; }

  /// It moves slowly enough that a detection at its edge is a part of the same obstacle.
  bool is_standing() const;

  /// Seen by enough scans and rays to be published.
  bool is_confirmed(const Lifecycle& lifecycle) const {
    return seen_scans_ >= lifecycle.confirming_scans && rays_ >= lifecycle.confirming_rays;
  }

  /// Seen by so many scans that its velocity means something.
  bool knows_its_speed() const { return seen_scans_ >= kScansToKnowTheSpeed; }

  /// When a scan last saw something of it.
  time::Stamp last_seen() const { return last_seen_; }

  geometry::Point2 position_in_map() const { return {filter_->state().x(), filter_->state().y()}; }

  /// Where it was `lag_s` before the filter's moment, at constant velocity.
  geometry::Point2 position_before(double lag_s) const;

  /// Standard deviation of its position, the mean of both axes.
  double position_sigma_m() const;

  /// Predicts the state; a static track stays where it is while no lidar sees it.
  void move_on(time::Stamp from, time::Stamp to);

  /// Updates the state with a detection measured at `measured`; the state's moment is `moment`, not before it.
  void take(const Detection& detection, time::Stamp measured, time::Stamp moment, const Lifecycle& lifecycle);

  /// A scan has hits on it that are not enough to measure it: it counts as seen, its state stays.
  void glimpse(time::Stamp measured);

  /// The radius that the disc must have to cover what the detection shows of the surface.
  double reach_to_cover(const Detection& detection) const;

  /// Grows towards this radius, half of the way a scan.
  void cover(double reach_m);

  /// A scan's rays went through its position.
  void miss() { ++free_scans_; }

  /// Another track is of the same obstacle: this one is dropped.
  void replace() { is_replaced_ = true; }
  bool is_replaced() const { return is_replaced_; }

  /// Rays went through its position too often.
  bool is_looked_through(const Lifecycle& lifecycle) const;

  /// Not seen for longer than a track of its kind is kept.
  bool is_overdue(time::Stamp now, const Lifecycle& lifecycle) const;

  /// The track as it is published. `now`: for its ages; the state is at the filter's moment.
  Track published(time::Stamp now) const;

 private:
  static constexpr int kScansToKnowTheSpeed = 4;

  /// The radius follows the detection: quickly when it must grow, slowly when it may shrink.
  void adapt_radius(const Detection& detection, const Lifecycle& lifecycle);

  /// It is static when it has stayed near one place for long enough.
  void settle(time::Stamp measured, const Lifecycle& lifecycle);

  std::uint64_t id_;
  std::unique_ptr<MotionFilter> filter_;
  double radius_m_;

  time::Stamp born_;
  time::Stamp last_seen_;
  int seen_scans_{1};
  int rays_;  // that hit it, of which at most two of each scan count
  int free_scans_{0};

  geometry::Point2 anchor_in_map_;  // it has stayed near here
  time::Stamp anchored_{};          // since then
  bool is_static_{false};
  bool is_replaced_{false};
};

}  // namespace aisle::obstacle_tracker
