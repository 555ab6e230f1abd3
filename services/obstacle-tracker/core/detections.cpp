#include "services/obstacle-tracker/core/detections.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace aisle::obstacle_tracker {
namespace {

using geometry::Point2;

/// A cluster measured along and across the line of sight.
struct View {
  Point2 along;         // unit vector, away from the sensor
  Point2 across;        // unit vector, to the left of it
  double range_m{0.0};  // of the hits, on average
  double near_m{0.0};   // depth of the nearest surface
  double right_m{0.0};  // least and greatest offset across
  double left_m{0.0};
};

/// Axes and extent of the hits as the sensor sees them.
View look_at(const std::vector<Hit>& hits, Point2 sensor_in_map) {
  // Along: from the sensor to the mean of the hits. Across: a quarter turn to the left of it.
  Point2 sum{};
  for (const Hit& hit : hits) sum = sum + hit.in_map;
  const Point2 to_middle = (1.0 / static_cast<double>(hits.size())) * sum - sensor_in_map;

  View view;
  view.range_m = std::max(1e-3, geometry::norm(to_middle));
  view.along = (1.0 / view.range_m) * to_middle;
  view.across = {-view.along.y, view.along.x};

  // Extent across, and all depths along.
  std::vector<double> depths_m;
  depths_m.reserve(hits.size());
  view.right_m = 1e9;
  view.left_m = -1e9;

  for (const Hit& hit : hits) {
    const Point2 from_sensor = hit.in_map - sensor_in_map;
    depths_m.push_back(geometry::dot(from_sensor, view.along));
    const double offset_m = geometry::dot(from_sensor, view.across);
    view.right_m = std::min(view.right_m, offset_m);
    view.left_m = std::max(view.left_m, offset_m);
  }

  // Depth of the surface: the mean of the nearest third, which one noisy hit moves little.
  std::sort(depths_m.begin(), depths_m.end());
  const std::size_t nearest = (depths_m.size() + 2) / 3;
  for (std::size_t i = 0; i < nearest; ++i) view.near_m += depths_m[i] / static_cast<double>(nearest);

  return view;
}

/// The seen half width, pulled towards a person's radius as far as the spacing of the rays leaves it open: the weighted
/// mean r = r_usual + k (w - r_usual) with k = s_usual^2 / (s_usual^2 + s_seen^2), s_seen growing with the spacing.
double blend_radius_m(double seen_half_width_m, double ray_gap_m, const Shape& shape) {
  const double sigma_m = 0.02 + 0.3 * ray_gap_m;
  const double trust = shape.usual_radius_sigma_m * shape.usual_radius_sigma_m /
                       (shape.usual_radius_sigma_m * shape.usual_radius_sigma_m + sigma_m * sigma_m);

  return shape.usual_radius_m + trust * (seen_half_width_m - shape.usual_radius_m);
}

/// Greatest distance from `from` to a hit.
double furthest_m(const std::vector<Hit>& hits, Point2 from) {
  double furthest_m = 0.0;
  for (const Hit& hit : hits) furthest_m = std::max(furthest_m, geometry::distance(hit.in_map, from));
  return furthest_m;
}

/// Variances along and across the view, turned into map's axes: A diag(along, across) A'.
Eigen::Matrix2d covariance_of(const View& view, double along_variance, double across_variance) {
  Eigen::Matrix2d axes;
  axes << view.along.x, view.across.x, view.along.y, view.across.y;

  return axes * Eigen::Vector2d(along_variance, across_variance).asDiagonal() * axes.transpose();
}

/// Covariance of a detection's position, the pose's error left out: the noise of the ranges, and what the view does not
/// show. `ends_open`: at how many of its two ends the thing may go on; from an end that shows, it is measured to within
/// the doubt about its size.
Eigen::Matrix2d doubt_of_view(const View& view, const Detection& detection, int ends_open, double ray_gap_m,
                              const SensorNoise& noise, const Shape& shape) {
  const double size_m = 0.015 + 0.25 * std::max(0.0, detection.radius_m - shape.usual_radius_m);

  double hidden_m = ends_open > 0 ? 0.05 : 0.0;
  if (ends_open == 2) hidden_m += 0.7 * std::max(0.0, detection.radius_m - 0.5 * (view.left_m - view.right_m));

  const double along_variance =
      noise.range_m * noise.range_m / std::max(1.0, static_cast<double>(detection.surface_in_map.size()) / 3.0) +
      size_m * size_m;

  return covariance_of(view, along_variance, ray_gap_m * ray_gap_m / 24.0 + size_m * size_m + hidden_m * hidden_m);
}

/// Covariance of a detection's position by the error of the pose that the scan was taken from: its place, and across
/// the view the swing of its heading.
Eigen::Matrix2d doubt_of_pose(const View& view, const SensorNoise& noise) {
  const double swing_m = noise.yaw_rad * view.range_m;
  return covariance_of(view, noise.pose_m * noise.pose_m, noise.pose_m * noise.pose_m + swing_m * swing_m);
}

/// Centre of the least disc around the hits, within a centimetre or two: step 1/(i + 1) of the way to the farthest hit,
/// round by round (Badoiu, Clarkson, "Smaller core-sets for balls", 2003).
Point2 middle_of(const std::vector<Hit>& hits) {
  constexpr int kRounds = 48;
  Point2 center = hits.front().in_map;

  for (int round = 1; round <= kRounds; ++round) {
    const auto further = [&](const Hit& a, const Hit& b) {
      return geometry::distance(a.in_map, center) < geometry::distance(b.in_map, center);
    };

    const Point2 furthest = std::max_element(hits.begin(), hits.end(), further)->in_map;
    center = center + (1.0 / (round + 1)) * (furthest - center);
  }

  return center;
}

/// Guess of a small round thing, whole or cut: its radius, and the offset of its middle across the view.
struct Round {
  double radius_m;
  double middle_m;
};

/// A whole thing is as wide as it is seen. One that is cut is a person whose visible edge is where it is seen.
Round guess_round(const Cluster& cluster, const View& view, double ray_gap_m, const Shape& shape) {
  const double seen_half_width_m = 0.5 * (view.left_m - view.right_m + ray_gap_m);
  const bool is_cut = cluster.is_cut_left || cluster.is_cut_right;
  if (!is_cut || seen_half_width_m >= shape.usual_radius_m) {
    return {blend_radius_m(seen_half_width_m, ray_gap_m, shape), 0.5 * (view.left_m + view.right_m)};
  }

  Round round{shape.usual_radius_m, 0.5 * (view.left_m + view.right_m)};
  if (!cluster.is_cut_left) round.middle_m = view.left_m + 0.5 * ray_gap_m - round.radius_m;
  if (!cluster.is_cut_right) round.middle_m = view.right_m - 0.5 * ray_gap_m + round.radius_m;

  return round;
}

/// How far the hits bulge towards the sensor from the straight line between the first and the last.
double bulge_m(const std::vector<Hit>& hits, Point2 behind) {
  double bulge_m = 0.0;
  for (const Hit& hit : hits) bulge_m = std::max(bulge_m, -geometry::dot(hit.in_map - hits.front().in_map, behind));
  return bulge_m;
}

/// Centre of a thing too large for a person: behind a flat front, or in the middle of two sides.
Point2 middle_of_large(const std::vector<Hit>& hits, Point2 sensor_in_map) {
  constexpr double kDeepestGuess_m = 0.40;  // of a flat front: nothing shows how deep it is
  constexpr double kFlat = 0.15;

  const Point2 chord = hits.back().in_map - hits.front().in_map;
  const double length_m = std::max(1e-6, geometry::norm(chord));

  // Behind: across the line from the first hit to the last, away from the sensor.
  Point2 behind{-chord.y / length_m, chord.x / length_m};
  if (geometry::dot(hits.front().in_map - sensor_in_map, behind) < 0.0) behind = -1.0 * behind;

  // Two sides or a bulge show how deep it is; a flat front does not.
  if (bulge_m(hits, behind) > kFlat * length_m) return middle_of(hits);

  // The front lies midway between its ends, at the mean depth of its hits.
  Point2 sum{};
  for (const Hit& hit : hits) sum = sum + hit.in_map;
  const Point2 on_front = (1.0 / static_cast<double>(hits.size())) * sum;
  const Point2 on_chord = 0.5 * (hits.front().in_map + hits.back().in_map);
  const Point2 front = on_chord + geometry::dot(on_front - on_chord, behind) * behind;

  return front + std::min(0.5 * length_m, kDeepestGuess_m) * behind;
}

/// One disc for all these hits.
Detection fit_disc(const Cluster& cluster, const Scan& scan, Point2 sensor_in_map, const SensorNoise& noise,
                   const Shape& shape) {
  const View view = look_at(cluster.hits, sensor_in_map);
  const double ray_gap_m = view.range_m * scan.angle_step_rad;
  const double chord_m = geometry::distance(cluster.hits.front().in_map, cluster.hits.back().in_map);
  const bool is_small = 0.5 * (chord_m + ray_gap_m) < shape.large * shape.usual_radius_m;

  Detection detection;
  for (const Hit& hit : cluster.hits) detection.surface_in_map.push_back(hit.in_map);

  if (is_small) {
    const Round round = guess_round(cluster, view, ray_gap_m, shape);
    detection.position_in_map =
        sensor_in_map + (view.near_m + round.radius_m) * view.along + round.middle_m * view.across;
    detection.radius_m = std::max(round.radius_m, furthest_m(cluster.hits, detection.position_in_map) - noise.range_m);
  } else {
    // A corner may lie between two rays: half a gap more.
    detection.position_in_map = middle_of_large(cluster.hits, sensor_in_map);
    detection.radius_m = furthest_m(cluster.hits, detection.position_in_map) + 0.5 * ray_gap_m;
  }

  detection.is_partial = cluster.is_cut_left || cluster.is_cut_right;
  detection.offset_s = cluster.hits[cluster.hits.size() / 2].offset_s;

  const int ends_open = (cluster.is_cut_left ? 1 : 0) + (cluster.is_cut_right ? 1 : 0);
  detection.view_covariance = doubt_of_view(view, detection, ends_open, ray_gap_m, noise, shape);
  detection.covariance = detection.view_covariance + doubt_of_pose(view, noise);

  return detection;
}

/// The expected disc that a hit belongs to: the one with the nearest edge, within the margin; -1: none.
int claimant(const Hit& hit, const std::vector<Expected>& expected, const Shape& shape) {
  int best = -1;
  double best_m = shape.claim_margin_m;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double beyond_m = geometry::distance(hit.in_map, expected[i].position_in_map) - expected[i].radius_m;
    if (beyond_m < best_m) {
      best_m = beyond_m;
      best = static_cast<int>(i);
    }
  }

  return best;
}

/// The hits of each claimant as one part, unclaimed ones as one part a run. A part that does not end where the cluster
/// ends is cut there.
std::vector<Cluster> divide_by_claims(const Cluster& cluster, const std::vector<Expected>& expected,
                                      const Shape& shape) {
  constexpr int kUnclaimed = 1'000'000;
  std::map<int, Cluster> parts;
  int run = kUnclaimed;

  int previous = -1;
  for (const Hit& hit : cluster.hits) {
    const int owner = claimant(hit, expected, shape);

    if (owner < 0 && previous >= 0) ++run;
    previous = owner;
    parts[owner >= 0 ? owner : run].hits.push_back(hit);
  }

  std::vector<Cluster> divided;
  for (auto& [owner, part] : parts) {
    part.is_cut_right = part.hits.front().ray != cluster.hits.front().ray || cluster.is_cut_right;
    part.is_cut_left = part.hits.back().ray != cluster.hits.back().ray || cluster.is_cut_left;
    divided.push_back(std::move(part));
  }

  return divided;
}

/// Divides a cluster into pieces of about equal length along the surface, none longer than `piece_m`.
std::vector<Cluster> divide_by_length(const Cluster& cluster, double piece_m) {
  std::vector<double> along_m{0.0};
  for (std::size_t i = 1; i < cluster.hits.size(); ++i) {
    along_m.push_back(along_m.back() + geometry::distance(cluster.hits[i - 1].in_map, cluster.hits[i].in_map));
  }

  const auto pieces = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(along_m.back() / piece_m)));
  std::vector<Cluster> divided(pieces);
  for (std::size_t i = 0; i < cluster.hits.size(); ++i) {
    const auto piece = static_cast<std::size_t>(along_m[i] / (along_m.back() + 1e-9) * static_cast<double>(pieces));
    divided[std::min(piece, pieces - 1)].hits.push_back(cluster.hits[i]);
  }

  divided.erase(std::remove_if(divided.begin(), divided.end(), [](const Cluster& c) { return c.hits.empty(); }),
                divided.end());
  divided.front().is_cut_right = cluster.is_cut_right;
  divided.back().is_cut_left = cluster.is_cut_left;
  return divided;
}

/// The expected things that the cluster may show: those with a hit on their disc, or within the margin of it.
std::vector<Expected> near_to(const Cluster& cluster, const std::vector<Expected>& expected, const Shape& shape) {
  std::vector<Expected> near;
  for (const Expected& thing : expected) {
    const bool touches = std::any_of(cluster.hits.begin(), cluster.hits.end(), [&](const Hit& hit) {
      return geometry::distance(hit.in_map, thing.position_in_map) < thing.radius_m + shape.claim_margin_m;
    });

    if (touches) near.push_back(thing);
  }

  return near;
}

}  // namespace

std::vector<Detection> find_detections(const Scan& scan, const SortedScan& sorted, const std::vector<Cluster>& clusters,
                                       const std::vector<Expected>& expected, const SensorNoise& noise,
                                       const Shape& shape) {
  // A part stays one disc up to a size; what is larger is divided by length. Fewer than 4 hits are not worth dividing.
  std::vector<Detection> detections;
  const auto fit = [&](const Cluster& c) { return fit_disc(c, scan, sorted.sensor_in_map, noise, shape); };
  const auto add = [&](const Cluster& part, double largest_m) {
    const Detection whole = fit(part);
    if (whole.radius_m <= largest_m || part.hits.size() < 4) {
      detections.push_back(whole);
      return;
    }

    for (const Cluster& piece : divide_by_length(part, shape.piece_m)) detections.push_back(fit(piece));
  };

  // Expected things first: one of them holds the cluster together, several divide it.
  for (const Cluster& cluster : clusters) {
    const double across_m = geometry::distance(cluster.hits.front().in_map, cluster.hits.back().in_map);
    const bool may_be_several =
        across_m > 2.6 * shape.usual_radius_m || fit(cluster).radius_m > shape.max_disc_radius_m;

    const std::vector<Expected> near = may_be_several ? near_to(cluster, expected, shape) : std::vector<Expected>{};
    if (near.size() == 1) {
      add(cluster, shape.keep_whole * shape.max_disc_radius_m);
    } else if (near.empty()) {
      add(cluster, shape.max_disc_radius_m);
    } else {
      for (const Cluster& part : divide_by_claims(cluster, near, shape))
        add(part, shape.keep_whole * shape.max_disc_radius_m);
    }
  }

  return detections;
}

}  // namespace aisle::obstacle_tracker
