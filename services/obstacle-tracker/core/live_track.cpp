#include "services/obstacle-tracker/core/live_track.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::obstacle_tracker {
namespace {

Eigen::Vector2d vector_of(geometry::Point2 p) { return {p.x, p.y}; }

/// Of a scan's rays on the thing, at most two count: the scan's noise is common to all of them.
int rays_of(const Detection& detection) {
  return static_cast<int>(std::min<std::size_t>(2, detection.surface_in_map.size()));
}

}  // namespace

LiveTrack::LiveTrack(std::uint64_t id, const Detection& detection, const MotionModel& motion, time::Stamp moment)
    : id_(id),
      filter_(make_filter(motion, vector_of(detection.position_in_map), detection.covariance)),
      radius_m_(detection.radius_m),
      born_(moment),
      last_seen_(moment),
      rays_(rays_of(detection)),
      anchor_in_map_(detection.position_in_map),
      anchored_(moment) {}

geometry::Point2 LiveTrack::position_before(double lag_s) const {
  const Eigen::Vector4d& x = filter_->state();
  return {x(0) - lag_s * x(2), x(1) - lag_s * x(3)};
}

double LiveTrack::position_sigma_m() const {
  return std::sqrt(0.5 * filter_->covariance().topLeftCorner<2, 2>().trace());
}

void LiveTrack::move_on(time::Stamp from, time::Stamp to) {
  constexpr double kLookedAway_s = 0.25;

  const double dt_s = time::seconds(to - from);
  if (dt_s <= 0.0) return;

  if (is_static_ && time::seconds(to - last_seen_) > kLookedAway_s) {
    filter_->stand(dt_s);
  } else {
    filter_->predict(dt_s);
  }
}

void LiveTrack::take(const Detection& detection, time::Stamp measured, time::Stamp moment, const Lifecycle& lifecycle) {
  // A surprise beyond the turn gate means that it turned or started: trust its velocity less, then measure.
  const Eigen::Vector2d position = vector_of(detection.position_in_map);
  const double lag_s = time::seconds(moment - measured);
  const bool has_turned =
      knows_its_speed() && filter_->innovation(position, detection.covariance, lag_s).distance2 > lifecycle.turn_gate;
  if (has_turned) filter_->loosen(lifecycle.turn_speed_sigma_mps);

  filter_->update(position, detection.covariance, lag_s);

  ++seen_scans_;
  rays_ = std::min(1000, rays_ + rays_of(detection));

  glimpse(measured);
  adapt_radius(detection, lifecycle);
  settle(measured, lifecycle);
}

void LiveTrack::glimpse(time::Stamp measured) {
  last_seen_ = std::max(last_seen_, measured);
  free_scans_ = 0;
}

bool LiveTrack::is_standing() const {
  constexpr double kSlow_mps = 0.3;
  return is_static_ || filter_->state().tail<2>().norm() < kSlow_mps;
}

double LiveTrack::reach_to_cover(const Detection& detection) const {
  double reach_m = 0.0;
  for (const geometry::Point2 hit : detection.surface_in_map)
    reach_m = std::max(reach_m, geometry::distance(hit, position_in_map()));

  return reach_m;
}

void LiveTrack::cover(double reach_m) {
  constexpr double kGrow = 0.5;
  if (reach_m > radius_m_) radius_m_ += kGrow * (reach_m - radius_m_);
}

void LiveTrack::adapt_radius(const Detection& detection, const Lifecycle& lifecycle) {
  constexpr double kShrink = 0.05;
  constexpr double kNoise_m = 0.02;

  // A thing that stands is covered whole; of one that moves, the newest view counts.
  const double reach_m = is_standing() ? reach_to_cover(detection) - kNoise_m : 0.0;
  const double wanted_m = std::min(lifecycle.max_radius_m, std::max(reach_m, detection.radius_m));

  cover(wanted_m);
  if (wanted_m < radius_m_ && !detection.is_partial) radius_m_ += kShrink * (wanted_m - radius_m_);
}

void LiveTrack::settle(time::Stamp measured, const Lifecycle& lifecycle) {
  // Views of a large thing differ more.
  const double reach_m = std::max(lifecycle.static_reach_m, 0.7 * radius_m_);
  if (geometry::distance(position_in_map(), anchor_in_map_) > reach_m) {
    anchor_in_map_ = position_in_map();
    anchored_ = measured;
  }

  is_static_ = time::seconds(measured - anchored_) >= lifecycle.static_after_s;
}

bool LiveTrack::is_looked_through(const Lifecycle& lifecycle) const {
  return free_scans_ >= (is_confirmed(lifecycle) ? lifecycle.free_scans : 1);
}

bool LiveTrack::is_overdue(time::Stamp now, const Lifecycle& lifecycle) const {
  // What was seen for a moment is not carried on for longer than that: a wrong speed would make it wander.
  const double seen_s = time::seconds(last_seen_ - born_);
  double limit_s = std::clamp(seen_s, lifecycle.unconfirmed_timeout_s,
                              std::max(lifecycle.unconfirmed_timeout_s, lifecycle.unseen_timeout_s));

  if (!is_confirmed(lifecycle)) limit_s = lifecycle.unconfirmed_timeout_s;
  if (is_static_) limit_s = lifecycle.static_timeout_s;

  return time::seconds(now - last_seen_) > limit_s;
}

Track LiveTrack::published(time::Stamp now) const {
  Track track;
  track.id = id_;
  track.position_in_map = position_in_map();
  if (!is_static_) track.velocity_in_map = {filter_->state()(2), filter_->state()(3)};

  // Row by row, of (x, y, vx, vy).
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      track.covariance[static_cast<std::size_t>(4 * row + column)] = filter_->covariance()(row, column);
  }

  track.radius_m = radius_m_;
  track.age_s = std::max(0.0, time::seconds(now - born_));
  track.unseen_s = std::max(0.0, time::seconds(now - last_seen_));
  track.is_static = is_static_;

  return track;
}

}  // namespace aisle::obstacle_tracker
