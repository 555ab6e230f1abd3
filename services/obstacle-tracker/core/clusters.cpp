#include "services/obstacle-tracker/core/clusters.hpp"

#include <algorithm>
#include <cmath>

#include "services/obstacle-tracker/core/disjoint_sets.hpp"

namespace aisle::obstacle_tracker {
namespace {

/// Of a set of hits: how many, and the first and last in the order of the rays.
struct Extent {
  std::size_t hits{0};
  std::size_t first{0};
  std::size_t last{0};
};

/// How near another hit must be to belong to this one.
double reach_m(const Hit& hit, const Scan& scan, const Clustering& clustering) {
  return clustering.base_m + clustering.per_gap * hit.range_m * scan.angle_step_rad;
}

/// Single linkage: looks forward from each hit, over neighbouring rays only.
void join_neighbours(const Scan& scan, const std::vector<Hit>& hits, const Clustering& clustering, DisjointSets& sets) {
  const bool wraps = is_full_turn(scan);

  const std::size_t n = hits.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double own_reach_m = reach_m(hits[i], scan, clustering);

    // Beyond this angle no hit can be within reach of this one, whatever its range.
    const double ratio = own_reach_m / hits[i].range_m;
    const double widest_rad = ratio < 1.0 ? std::asin(ratio) : geometry::kPi;

    for (std::size_t step = 1; step < n; ++step) {
      const std::size_t j = i + step;

      if (j >= n && !wraps) break;

      const Hit& other = hits[j % n];
      const double turn_rad = (other.ray - hits[i].ray) * scan.angle_step_rad + (j >= n ? 2.0 * geometry::kPi : 0.0);

      if (turn_rad > widest_rad) break;
      if (geometry::distance(hits[i].in_map, other.in_map) <= own_reach_m) sets.join(i, j % n);
    }
  }
}

/// Looks at the ray beside the cluster's last one: is its end clearly nearer, so that it may hide the rest, or an
/// explained hit alongside, which may have swallowed it? `direction`: +1 to the left, -1 to the right.
/// May what ends at `hit` go on behind the neighbouring ray?
bool is_cut(const Scan& scan, const SortedScan& sorted, const Hit& hit, int direction) {
  constexpr double kClearlyNearer_m = 0.15;
  constexpr double kAlongside_m = 0.4;
  const int count = static_cast<int>(scan.ranges_m.size());

  int ray = hit.ray + direction;
  if (ray < 0 || ray >= count) {
    if (!is_full_turn(scan)) return true;
    ray = (ray + count) % count;
  }

  const RayEnd end = sorted.ends[static_cast<std::size_t>(ray)];
  if (end == RayEnd::kTooNear) return true;
  if (end == RayEnd::kNothing) return false;
  const double beyond_m = static_cast<double>(scan.ranges_m[static_cast<std::size_t>(ray)]) - hit.range_m;

  return beyond_m < -kClearlyNearer_m || (end != RayEnd::kUnknown && beyond_m < kAlongside_m);
}

/// Joins the few hits on a side that the rays graze to the front that it belongs to: single hits, each behind the one
/// before, next to the edge of a front too wide for a person.
void join_grazed_sides(const Scan& scan, const std::vector<Hit>& hits, const Clustering& clustering,
                       DisjointSets& sets) {
  // Size and ends of each cluster so far, and which hit each ray made.
  std::vector<int> hit_of_ray(scan.ranges_m.size(), -1);
  std::vector<Extent> extent_of_root(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    hit_of_ray[static_cast<std::size_t>(hits[i].ray)] = static_cast<int>(i);
    Extent& extent = extent_of_root[sets.root(i)];

    if (extent.hits++ == 0) extent.first = i;
    extent.last = i;
  }

  constexpr std::size_t kFewHits = 6;
  const int count = static_cast<int>(scan.ranges_m.size());
  const bool wraps = is_full_turn(scan);
  const std::vector<Extent> extents = extent_of_root;

  // From both ends of each wide front, walk outwards ray by ray.
  for (const Extent& front : extents) {
    if (front.hits < 3 || geometry::distance(hits[front.first].in_map, hits[front.last].in_map) < clustering.front_m)
      continue;

    for (const int direction : {-1, 1}) {
      std::size_t edge = direction < 0 ? front.first : front.last;
      for (int step = 0; step < count; ++step) {
        int ray = hits[edge].ray + direction;
        if (wraps) ray = (ray + count) % count;
        const int next = ray >= 0 && ray < count ? hit_of_ray[static_cast<std::size_t>(ray)] : -1;
        if (next < 0) break;

        const auto side = static_cast<std::size_t>(next);
        const bool is_few = extent_of_root[sets.root(side)].hits <= kFewHits;
        const bool is_behind = hits[side].range_m > hits[edge].range_m;
        if (!is_few || !is_behind || geometry::distance(hits[side].in_map, hits[edge].in_map) > clustering.side_gap_m)
          break;

        sets.join(side, front.first);  // its own root goes; the front's stays
        edge = side;
      }
    }
  }
}

}  // namespace

std::vector<Cluster> find_clusters(const Scan& scan, const SortedScan& sorted, const Clustering& clustering) {
  // Join what belongs together.
  const std::vector<Hit>& hits = sorted.hits;
  DisjointSets sets(hits.size());
  join_neighbours(scan, hits, clustering, sets);
  join_grazed_sides(scan, hits, clustering, sets);

  // Collect the sets as clusters.
  std::vector<Cluster> clusters;
  std::vector<int> cluster_of_root(hits.size(), -1);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    int& cluster = cluster_of_root[sets.root(i)];

    if (cluster < 0) {
      cluster = static_cast<int>(clusters.size());
      clusters.emplace_back();
    }

    clusters[static_cast<std::size_t>(cluster)].hits.push_back(hits[i]);
  }

  // Order each by bearing. Hits come ray by ray, so that a cluster across the first ray begins at its second part.
  for (Cluster& cluster : clusters) {
    const double from_rad = cluster.hits.front().bearing_rad;
    std::sort(cluster.hits.begin(), cluster.hits.end(), [from_rad](const Hit& a, const Hit& b) {
      return geometry::wrap(a.bearing_rad - from_rad) < geometry::wrap(b.bearing_rad - from_rad);
    });

    cluster.is_cut_right = is_cut(scan, sorted, cluster.hits.front(), -1);
    cluster.is_cut_left = is_cut(scan, sorted, cluster.hits.back(), +1);
  }

  return clusters;
}

}  // namespace aisle::obstacle_tracker
