#include "services/obstacle-tracker/core/tracker.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "services/obstacle-tracker/core/alignment.hpp"
#include "services/obstacle-tracker/core/association.hpp"
#include "services/obstacle-tracker/core/sight.hpp"

namespace aisle::obstacle_tracker {
namespace {

using namespace std::chrono_literals;
using geometry::Point2;

constexpr time::Stamp kMaxAge = 1s;       // an older scan is dropped
constexpr time::Stamp kMaxFuture = 50ms;  // and one stamped later than now by more than this

Eigen::Vector2d vector_of(Point2 p) { return {p.x, p.y}; }

/// When the detection was measured: within the sweep of its scan.
time::Stamp moment_of(const Detection& detection, const Scan& scan) {
  return scan.stamp + time::from_seconds(detection.offset_s);
}

/// Is the point inside a wall or a vehicle? No unseen obstacle can stand there.
bool is_taken(Point2 in_map, const Scan& scan, const grid::ClearanceField& clearance,
              const std::vector<KnownVehicle>& vehicles, const Explained& explained) {
  if (clearance.clearance_m(in_map) <= 0.0) return true;

  return std::any_of(vehicles.begin(), vehicles.end(), [&](const KnownVehicle& vehicle) {
    const bool is_fresh = std::abs(time::seconds(scan.stamp - vehicle.stamp)) <= explained.vehicle_max_age_s;
    return is_fresh && distance_to_body_m(vehicle, vehicle.base_in_map, in_map) <= 0.0;
  });
}

/// Solid things do not walk into each other: where predictions come to overlap, both are expected just apart, on the
/// line on which they came. `before`: where each was a moment ago. Standing things may overlap, as a disc is more than
/// the thing that it covers.
void keep_apart(std::vector<Expected>& expected, const std::vector<Point2>& before) {
  constexpr double kTouching = 0.9;  // x the sum of the radii: people are no discs
  constexpr double kComing_m = 0.05;

  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t j = i + 1; j < expected.size(); ++j) {
      const Point2 came_from = before[j] - before[i];
      const double before_m = geometry::norm(came_from);
      const Point2 between = expected[j].position_in_map - expected[i].position_in_map;
      const double least_m = kTouching * (expected[i].radius_m + expected[j].radius_m);
      if (geometry::norm(between) >= std::min(least_m, before_m - kComing_m)) continue;

      // Half of the missing distance each, along the line between their earlier places.
      const Point2 direction = (1.0 / before_m) * came_from;
      const Point2 push = 0.5 * (least_m - geometry::dot(between, direction)) * direction;

      expected[i].position_in_map = expected[i].position_in_map - push;
      expected[j].position_in_map = expected[j].position_in_map + push;
    }
  }
}

/// Two people of two velocities, and both are known: they will soon be apart again, although one of them may be hidden
/// behind the other for a moment. A static track's velocity is 0, whatever a measurement of the other one makes of it.
/// Larger things do not count, because they are seen a piece at a time, and their pieces wander.
bool are_passing(const LiveTrack& a, const LiveTrack& b, const Shape& shape) {
  constexpr double kDiffers_mps = 0.8;
  constexpr double kWalksPast_mps = 0.5;  // less is enough beside one that stands

  const auto is_person = [&](const LiveTrack& track) {
    return track.knows_its_speed() && track.radius_m() < shape.large * shape.usual_radius_m;
  };
  const auto velocity_of = [](const LiveTrack& track) -> Eigen::Vector2d {
    if (track.is_static()) return Eigen::Vector2d::Zero();
    return track.filter().state().tail<2>();
  };

  if (!is_person(a) || !is_person(b)) return false;

  const double difference_mps = (velocity_of(a) - velocity_of(b)).norm();
  return difference_mps > (a.is_static() || b.is_static() ? kWalksPast_mps : kDiffers_mps);
}

}  // namespace

Tracker::Tracker(const TrackerParams& params, std::uint64_t first_id) : params_(params), next_id_(first_id) {}

TakeResult Tracker::take(const Scan& scan, const std::vector<KnownVehicle>& vehicles,
                         const grid::ClearanceField* clearance, time::Stamp now) {
  TakeResult result;
  result.dropped = why_drop(scan, vehicles, clearance, now);

  if (result.dropped) {
    count_dropped(*result.dropped);
    return result;
  }

  // Bring all tracks to the moment of the last ray.
  ++scans_used_;
  move_on(scan.stamp + time::from_seconds(scan.sweep_s));

  // From rays to detections.
  const SensorNoise noise = params_.noise.in(scan);
  const SortedScan sorted = sort_rays(scan, *clearance, vehicles, noise, params_.explained);
  const std::vector<Cluster> clusters = find_clusters(scan, sorted, params_.clustering);
  std::vector<Detection> detections =
      find_detections(scan, sorted, clusters, expected_at(scan.stamp), noise, params_.shape);

  // From detections to tracks.
  Matching matching = match(detections, scan);
  if (params_.lifecycle.mark_gate > 0.0) take_out_pose_error(detections, matching, scan, sorted);
  take_in(detections, scan, matching, result);
  look_for_unmatched(scan, sorted, matching);
  merge_doubles(detections, matching);

  // Drop what is gone: merged, looked through, not seen for long, or standing in a wall or a vehicle.
  constexpr double kLookedAway_s = 0.3;
  bury(
      [&](const LiveTrack& track) {
        if (track.is_replaced() || track.is_looked_through(params_.lifecycle) ||
            track.is_overdue(moment_, params_.lifecycle))
          return true;

        const bool is_unseen = time::seconds(moment_ - track.last_seen()) > kLookedAway_s;
        return is_unseen && is_taken(track.position_in_map(), scan, *clearance, vehicles, params_.explained);
      },
      result.lost);

  return result;
}

std::optional<DropReason> Tracker::why_drop(const Scan& scan, const std::vector<KnownVehicle>& vehicles,
                                            const grid::ClearanceField* clearance, time::Stamp now) {
  const bool is_known = std::any_of(vehicles.begin(), vehicles.end(),
                                    [&](const KnownVehicle& vehicle) { return vehicle.agv_id == scan.agv_id; });

  if (!is_known) return DropReason::kUnknownVehicle;
  if (clearance == nullptr) return DropReason::kNoMap;
  if (const auto fault = find_fault(scan)) return fault;
  if (scan.stamp > now + kMaxFuture) return DropReason::kFuture;
  if (now - scan.stamp > kMaxAge) return DropReason::kTooOld;

  // What is remembered of this vehicle's scans.
  const auto [entry, is_first] = sensors_.try_emplace(scan.agv_id);
  if (sensors_.size() > vehicles.size()) forget_who_left(vehicles);

  Sensor& sensor = entry->second;
  if (!is_first && scan.stamp <= sensor.newest) return DropReason::kNotNewer;
  if (!has_usual_count(sensor, scan.ranges_m.size())) return DropReason::kWrongCount;
  sensor.newest = scan.stamp;

  return std::nullopt;
}

/// What is remembered of vehicles grows no larger than the fleet. The scanning vehicle is among `vehicles`, and stays.
void Tracker::forget_who_left(const std::vector<KnownVehicle>& vehicles) {
  for (auto sensor = sensors_.begin(); sensor != sensors_.end();) {
    const auto is_same = [&](const KnownVehicle& vehicle) { return vehicle.agv_id == sensor->first; };
    sensor = std::any_of(vehicles.begin(), vehicles.end(), is_same) ? std::next(sensor) : sensors_.erase(sensor);
  }
}

/// The first scan says what is usual; another number of rays becomes usual when it comes three times in a row.
bool Tracker::has_usual_count(Sensor& sensor, std::size_t rays) const {
  constexpr int kTimesToBecomeUsual = 3;

  if (sensor.rays == 0) sensor.rays = rays;

  if (rays == sensor.rays) {
    sensor.other_times = 0;
    return true;
  }

  sensor.other_times = rays == sensor.other_rays ? sensor.other_times + 1 : 1;
  sensor.other_rays = rays;
  if (sensor.other_times < kTimesToBecomeUsual) return false;

  sensor.rays = rays;
  sensor.other_times = 0;

  return true;
}

void Tracker::move_on(time::Stamp to) {
  if (to <= moment_) return;

  for (LiveTrack& track : live_) track.move_on(moment_, to);
  moment_ = to;
}

std::vector<Expected> Tracker::expected_at(time::Stamp moment) const {
  constexpr double kClearOfOthers_s = 0.2;
  const double lag_s = time::seconds(moment_ - moment);

  std::vector<Expected> expected;
  std::vector<Point2> before;
  expected.reserve(live_.size());
  before.reserve(live_.size());

  for (const LiveTrack& track : live_) {
    if (!track.is_confirmed(params_.lifecycle)) continue;
    expected.push_back({track.position_before(lag_s), track.radius_m()});
    before.push_back(track.position_before(lag_s + kClearOfOthers_s));
  }

  keep_apart(expected, before);
  return expected;
}

Tracker::Matching Tracker::match(const std::vector<Detection>& detections, const Scan& scan) const {
  constexpr double kFarthest_m = 3.0;
  constexpr double kLongestWait_s = 0.3;
  constexpr double kUnconfirmedHandicap = 14.0;

  const Lifecycle& lifecycle = params_.lifecycle;

  // More than any pair costs, so that no track is left unmatched without need.
  const double alone = lifecycle.gate + kUnconfirmedHandicap + 2.0;

  std::vector<Candidate> candidates;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    const Detection& detection = detections[d];
    const double lag_s = time::seconds(moment_ - moment_of(detection, scan));

    for (std::size_t t = 0; t < live_.size(); ++t) {
      const double away_m = geometry::distance(live_[t].position_before(lag_s), detection.position_in_map);
      if (away_m > kFarthest_m) continue;

      // Gate: within the squared Mahalanobis distance, or within the way of a fast thing since it was seen.
      const auto innovation =
          live_[t].filter().innovation(vector_of(detection.position_in_map), detection.covariance, lag_s);
      const double waited_s = std::clamp(time::seconds(moment_ - live_[t].last_seen()), 0.0, kLongestWait_s);
      if (innovation.distance2 > lifecycle.gate && away_m > lifecycle.gate_speed_mps * waited_s) continue;

      // Cost: r' S^-1 r + ln det S, -2 times the logarithm of the measurement's likelihood but for a constant. A track
      // that is not confirmed yet takes what the confirmed ones leave.
      const double likelihood =
          std::min(innovation.distance2, lifecycle.gate) + std::min(1.9, std::log(innovation.covariance.determinant()));
      const double handicap = live_[t].is_confirmed(lifecycle) ? 0.0 : kUnconfirmedHandicap;
      candidates.push_back({static_cast<int>(d), static_cast<int>(t), likelihood + handicap});
    }
  }

  Matching matching{assign(static_cast<int>(detections.size()), static_cast<int>(live_.size()), candidates, alone),
                    std::vector<char>(live_.size(), 0)};
  for (const int track : matching.track_of) {
    if (track >= 0) matching.is_matched[static_cast<std::size_t>(track)] = 1;
  }

  return matching;
}

void Tracker::take_out_pose_error(std::vector<Detection>& detections, const Matching& matching, const Scan& scan,
                                  const SortedScan& sorted) const {
  // Predicted position of each matched, confirmed track: what was seen less the innovation's residual.
  std::vector<std::optional<Prediction>> predictions(detections.size());
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (matching.track_of[d] < 0) continue;

    const LiveTrack& track = live_[static_cast<std::size_t>(matching.track_of[d])];
    if (!track.is_confirmed(params_.lifecycle)) continue;

    const Eigen::Vector2d seen = vector_of(detections[d].position_in_map);
    const double lag_s = time::seconds(moment_ - moment_of(detections[d], scan));
    const auto expected = track.filter().innovation(seen, Eigen::Matrix2d::Zero(), lag_s);

    predictions[d] = Prediction{seen - expected.residual, expected.covariance};
  }

  align(detections, predictions, sorted.sensor_in_map, params_.noise.in(scan), params_.lifecycle.mark_gate);
}

void Tracker::take_in(const std::vector<Detection>& detections, const Scan& scan, Matching& matching,
                      TakeResult& result) {
  std::vector<LiveTrack> born;
  for (std::size_t d = 0; d < detections.size(); ++d) {
    const Detection& detection = detections[d];
    const time::Stamp measured = moment_of(detection, scan);

    if (matching.track_of[d] >= 0) {
      LiveTrack& track = live_[static_cast<std::size_t>(matching.track_of[d])];
      track.take(detection, measured, moment_, params_.lifecycle);
      if (track.is_confirmed(params_.lifecycle)) result.seen.push_back(track.id());
    } else if (!is_part_of_known(detection, measured, matching)) {
      matching.track_of[d] = static_cast<int>(live_.size() + born.size());
      born.emplace_back(next_id_++, detection, params_.motion, measured);
      born.back().move_on(measured, moment_);
    }
  }

  std::move(born.begin(), born.end(), std::back_inserter(live_));
}

/// A second piece of a thing that is already tracked as one disc is not another thing; the disc grows to cover it.
bool Tracker::is_part_of_known(const Detection& detection, time::Stamp measured, Matching& matching) {
  constexpr double kOverhang_m = 0.1;
  const double lag_s = time::seconds(moment_ - measured);
  const double largest_m = params_.shape.keep_whole * params_.shape.max_disc_radius_m;

  for (std::size_t t = 0; t < live_.size(); ++t) {
    const double away_m = geometry::distance(live_[t].position_before(lag_s), detection.position_in_map);
    const double reach_m = live_[t].reach_to_cover(detection);
    const bool is_inside = away_m + 0.5 * detection.radius_m <= live_[t].radius_m() + kOverhang_m ||
                           (live_[t].is_standing() && reach_m <= live_[t].radius_m() + kOverhang_m);
    if (!is_inside || (live_[t].is_standing() && reach_m > std::max(largest_m, live_[t].radius_m()))) continue;

    live_[t].glimpse(measured);
    if (live_[t].is_standing()) live_[t].cover(reach_m);
    matching.is_matched[t] = 1;

    return true;
  }

  return false;
}

void Tracker::look_for_unmatched(const Scan& scan, const SortedScan& sorted, const Matching& matching) {
  constexpr double kMostDoubt_m = 1.0;

  const double lag_s = time::seconds(moment_ - scan.stamp);
  for (std::size_t t = 0; t < matching.is_matched.size(); ++t) {
    if (matching.is_matched[t]) continue;

    LiveTrack& track = live_[t];
    const double doubt_m = std::min(kMostDoubt_m, track.position_sigma_m());
    if (look_for(scan, sorted, track.position_before(lag_s), track.radius_m(), doubt_m) == Sight::kFree) track.miss();
  }
}

/// Two tracks at one position are of one obstacle, unless they pass each other. Where one scan has detections of both,
/// the detections' distance counts, not the tracks': a person who stops short of another is predicted to walk on into
/// them for a moment, and is still another person.
void Tracker::merge_doubles(const std::vector<Detection>& detections, const Matching& matching) {
  // The detection that shows each track in this scan, if any.
  std::vector<const Detection*> shown(live_.size(), nullptr);
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (matching.track_of[d] >= 0) shown[static_cast<std::size_t>(matching.track_of[d])] = &detections[d];
  }

  const Lifecycle& lifecycle = params_.lifecycle;
  std::vector<char> is_double(live_.size(), 0);
  for (std::size_t i = 0; i < live_.size(); ++i) {
    for (std::size_t j = i + 1; j < live_.size() && !is_double[i]; ++j) {
      if (is_double[j] || are_passing(live_[i], live_[j], params_.shape)) continue;
      const double away_m = geometry::distance(live_[i].position_in_map(), live_[j].position_in_map());

      // Near: by the detections where one scan shows both, else by the tracks.
      const bool both_seen = shown[i] != nullptr && shown[j] != nullptr;
      const double shown_m =
          both_seen ? geometry::distance(shown[i]->position_in_map, shown[j]->position_in_map) : away_m;

      // Or inside: most of a small disc within one of half as much again.
      const double smaller_m = std::min(live_[i].radius_m(), live_[j].radius_m());
      const double larger_m = std::max(live_[i].radius_m(), live_[j].radius_m());
      const bool is_inside = larger_m > 1.5 * smaller_m && away_m + 0.8 * smaller_m < larger_m;
      if (shown_m > (both_seen ? 0.5 : 1.0) * lifecycle.merge_m && !is_inside) continue;

      const bool keep_older = live_[i].is_confirmed(lifecycle) || !live_[j].is_confirmed(lifecycle);
      is_double[keep_older ? j : i] = 1;
    }
  }

  for (std::size_t t = 0; t < live_.size(); ++t) {
    if (is_double[t]) live_[t].replace();
  }
}

template <class IsGone>
void Tracker::bury(IsGone is_gone, std::vector<std::uint64_t>& lost) {
  const auto gone =
      std::stable_partition(live_.begin(), live_.end(), [&](const LiveTrack& track) { return !is_gone(track); });
  for (auto track = gone; track != live_.end(); ++track) {
    if (track->is_confirmed(params_.lifecycle)) lost.push_back(track->id());
  }

  live_.erase(gone, live_.end());
}

std::vector<std::uint64_t> Tracker::give_up_overdue(time::Stamp now) {
  std::vector<std::uint64_t> lost;
  bury([&](const LiveTrack& track) { return track.is_overdue(now, params_.lifecycle); }, lost);
  return lost;
}

std::vector<Track> Tracker::tracks(time::Stamp now) const {
  std::vector<Track> published;
  for (const LiveTrack& track : live_) {
    if (track.is_confirmed(params_.lifecycle)) published.push_back(track.published(now));
  }

  return published;
}

std::uint64_t Tracker::scans_dropped() const {
  return std::accumulate(dropped_.begin(), dropped_.end(), std::uint64_t{0});
}

}  // namespace aisle::obstacle_tracker
