#pragma once

#include <vector>

#include "services/obstacle-tracker/core/hits.hpp"

namespace aisle::obstacle_tracker {

/// Hits that lie together, by increasing bearing (seen from the sensor: from right to left).
struct Cluster {
  std::vector<Hit> hits;

  /// The thing may go on beyond the first hit: it is hidden there, removed as explained, or out of view.
  bool is_cut_right{false};

  /// The same beyond the last hit.
  bool is_cut_left{false};
};

/// Two hits belong together when they are nearer than base + per_gap x range x angle_step: the last product is the
/// distance between neighbouring rays at that range.
struct Clustering {
  double base_m{0.12};
  double per_gap{1.8};
  double front_m{0.65};     // a cluster this wide is no person: it may have a side that the rays graze
  double side_gap_m{0.45};  // between hits on such a side

  template <class Reader>
  void describe(Reader& r) {
    r.field("base_m", base_m, 0.01, 2.0)
        .field("per_gap", per_gap, 1.0, 10.0)
        .field("front_m", front_m, 0.1, 10.0)
        .field("side_gap_m", side_gap_m, 0.0, 2.0);
  }
};

/// Divides the hits of a scan into clusters by single linkage (each hit joins every hit near enough), so that a post in
/// front of a thing does not cut it in two. Then the few hits on a side which the rays graze join the front beside it.
/// Linear in the hits times the rays within reach of one.
/// @return clusters in the order of their first rays; each hit is in one of them
std::vector<Cluster> find_clusters(const Scan& scan, const SortedScan& sorted, const Clustering& clustering);

}  // namespace aisle::obstacle_tracker
