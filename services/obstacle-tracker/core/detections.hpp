#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/obstacle-tracker/core/clusters.hpp"

namespace aisle::obstacle_tracker {

/// An obstacle as one scan measures it: a disc in map.
struct Detection {
  geometry::Point2 position_in_map;
  Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};       // of the position
  Eigen::Matrix2d view_covariance{Eigen::Matrix2d::Zero()};  // the part of it that is not the vehicle's pose
  double radius_m{0.25};                                     // covers every hit it was made from
  double offset_s{0.0};                                      // measured this long after the scan's stamp
  std::vector<geometry::Point2> surface_in_map;              // the hits it was made from
  bool is_partial{false};                                    // it may be larger than seen
};

/// A track's predicted disc, by which the detections of obstacles that touch are kept apart.
struct Expected {
  geometry::Point2 position_in_map;
  double radius_m{0.25};
};

/// Sizes by which a cluster becomes one or more discs.
struct Shape {
  double usual_radius_m{0.25};  // of a person: assumed where the view does not show the size
  double usual_radius_sigma_m{0.06};
  double large{1.6};               // x usual_radius_m: larger than a person
  double max_disc_radius_m{0.72};  // a cluster that needs a larger disc becomes several
  double piece_m{0.70};            // of a long surface, for one disc
  double keep_whole{1.2};          // x max_disc_radius_m: a cluster tracked as one disc stays one up to here
  double claim_margin_m{0.15};     // a hit this near to an expected thing's edge belongs to it

  template <class Reader>
  void describe(Reader& r) {
    r.field("usual_radius_m", usual_radius_m, 0.05, 1.0)
        .field("usual_radius_sigma_m", usual_radius_sigma_m, 0.001, 1.0)
        .field("large", large, 1.0, 10.0)
        .field("max_disc_radius_m", max_disc_radius_m, 0.2, 1.5)
        .field("piece_m", piece_m, 0.1, 2.0)
        .field("keep_whole", keep_whole, 1.0, 2.0)
        .field("claim_margin_m", claim_margin_m, 0.0, 1.0);
  }
};

/// Makes discs of clusters.
///
/// Where the centre is: a scan shows the near side only. The centre of a small thing, and of a flat front, lies half
/// the seen width behind it. That of a large thing which shows two sides or a bulge is the middle of the least disc
/// around the hits: right for a person, for a square seen flat, and for one seen from a corner. A view cut at one side
/// is measured from the other; then the covariance grows across the view.
///
/// How many discs: a cluster too large for one disc is divided, first among the expected things that claim its hits
/// (two people who touch stay two, the pieces of a long thing stay where they are), then by length.
/// @param expected predicted discs of confirmed tracks at the scan's stamp
/// @param noise of this scan: SensorNoise::in()
std::vector<Detection> find_detections(const Scan& scan, const SortedScan& sorted, const std::vector<Cluster>& clusters,
                                       const std::vector<Expected>& expected, const SensorNoise& noise,
                                       const Shape& shape);

}  // namespace aisle::obstacle_tracker
