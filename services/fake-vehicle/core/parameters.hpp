#pragma once

#include "common/geometry/footprint.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::fake_vehicle {

/// A planar scanner in the vehicle's centre that looks all around at once.
struct LidarParameters {
  int rays{360};
  double range_min_m{0.05};
  double range_max_m{10.0};
  double range_noise_m{0.02};  // standard deviation
  double period_s{0.1};

  template <class Reader>
  void describe(Reader& r) {
    r.field("rays", rays, 8, 1440)
        .field("range_min_m", range_min_m, 0.0, 1.0)
        .field("range_max_m", range_max_m, 1.0, 100.0)
        .field("range_noise_m", range_noise_m, 0.0, 1.0)
        .field("period_s", period_s, 0.02, 2.0);
  }
};

/// One vehicle: what it is, how its drives answer, and how well it knows where it is.
struct Parameters {
  kinematics::Limits limits;
  double radius_m{0.35};  // of a disc
  double length_m{0.0};   // of a rectangle; 0: a disc
  double width_m{0.0};
  double ahead_m{0.0};            // of the rectangle's middle before the vehicle's frame
  double dead_time_s{0.05};       // from a command's arrival until the drives know of it
  double lag_s{0.05};             // time constant with which the drives follow; 0: at once
  double command_timeout_s{0.2};  // silence after which the vehicle brakes by itself
  double pose_noise_m{0.01};      // standard deviations of the published pose
  double yaw_noise_rad{0.003};
  LidarParameters lidar;

  template <class Reader>
  void describe(Reader& r) {
    r.section("limits", limits)
        .field("radius_m", radius_m, 0.05, 5.0)
        .field("length_m", length_m, 0.0, 10.0)
        .field("width_m", width_m, 0.0, 10.0)
        .field("ahead_m", ahead_m, -5.0, 5.0)
        .field("dead_time_s", dead_time_s, 0.0, 1.0)
        .field("lag_s", lag_s, 0.0, 2.0)
        .field("command_timeout_s", command_timeout_s, 0.05, 2.0)
        .field("pose_noise_m", pose_noise_m, 0.0, 1.0)
        .field("yaw_noise_rad", yaw_noise_rad, 0.0, 0.5)
        .section("lidar", lidar);
  }

  geometry::Footprint footprint() const { return geometry::footprint_of(radius_m, length_m, width_m, ahead_m); }
};

}  // namespace aisle::fake_vehicle
