#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/grid/clearance.hpp"
#include "services/obstacle-tracker/core/scan.hpp"

namespace aisle::obstacle_tracker {

/// How wrong a hit may be: standard deviations of the scanner's ranges and of the vehicle's pose.
struct SensorNoise {
  double range_m{0.02};
  double pose_m{0.02};    // of the vehicle's position, each axis
  double yaw_rad{0.009};  // of its heading: 0.5 degrees

  /// The noise of one scan: at least this, and more where the vehicle says that it is less sure of its pose.
  SensorNoise in(const Scan& scan) const;

  /// Standard deviation of a hit's place in map, across the view, in metres: sqrt(range^2 + pose^2 + (yaw r)^2) for a
  /// hit at the range r.
  double across_m(double range_m_of_hit) const;

  template <class Reader>
  void describe(Reader& r) {
    r.field("range_m", range_m, 0.0, 0.5).field("pose_m", pose_m, 0.0, 0.5).field("yaw_rad", yaw_rad, 0.0, 0.2);
  }
};

/// What counts as explained by the map or by a vehicle of the fleet: nearer to it than margin + `sigmas` x noise at
/// that range.
struct Explained {
  double wall_margin_m{0.10};
  double vehicle_margin_m{0.12};
  double sigmas{3.0};
  double vehicle_max_age_s{1.0};   // an older state explains nothing: what stands there is seen as an obstacle
  double vehicle_growth_mps{0.3};  // of the margin, with the age of the vehicle's state

  template <class Reader>
  void describe(Reader& r) {
    r.field("wall_margin_m", wall_margin_m, 0.0, 1.0)
        .field("vehicle_margin_m", vehicle_margin_m, 0.0, 1.0)
        .field("sigmas", sigmas, 0.0, 10.0)
        .field("vehicle_max_age_s", vehicle_max_age_s, 0.05, 10.0)
        .field("vehicle_growth_mps", vehicle_growth_mps, 0.0, 5.0);
  }
};

/// What the end of a ray is.
enum class RayEnd : std::uint8_t {
  kNothing,  // up to the sensor's range
  kTooNear,  // the vehicle itself
  kWall,     // explained by the map
  kVehicle,  // explained by a vehicle of the fleet
  kUnknown,  // a hit
};

/// A point that neither the map nor the fleet explains.
struct Hit {
  geometry::Point2 in_map;
  double range_m{0.0};
  double bearing_rad{0.0};  // of the ray, in map
  double offset_s{0.0};     // of the ray, from the scan's stamp
  int ray{0};
};

/// A scan, ray by ray.
struct SortedScan {
  geometry::Point2 sensor_in_map;           // at the middle of the sweep
  double middle_bearing_of_first_rad{0.0};  // bearing in map of ray 0, had the heading been that of mid-sweep
  std::vector<RayEnd> ends;                 // one a ray
  std::vector<Hit> hits;                    // in the order of the rays
};

/// Turns the ranges into points in map, each with the pose that the vehicle had at that ray, and sorts them by what
/// explains them. Hits are those which neither the map nor a vehicle explains.
/// @param clearance distances to the nearest occupied or unknown cell, of the newest map
/// @param vehicles may hold the scanning vehicle itself, which is left out
/// @param noise of this scan: SensorNoise::in()
SortedScan sort_rays(const Scan& scan, const grid::ClearanceField& clearance, const std::vector<KnownVehicle>& vehicles,
                     const SensorNoise& noise, const Explained& explained);

/// Distance in metres from a point to a vehicle's outline standing at `base_in_map`; 0 inside.
double distance_to_body_m(const KnownVehicle& vehicle, const geometry::Pose2& base_in_map, geometry::Point2 in_map);

}  // namespace aisle::obstacle_tracker
