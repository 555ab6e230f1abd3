#pragma once

#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// One turn of a vehicle's lidar, which sits in the origin of the vehicle's frame.
///
/// As measured: only its id and size are checked when it is decoded. The tracker refuses scans with numbers that make
/// no sense, and counts the refusals by reason (obstacle_tracker::find_fault).
struct Scan {
  std::string agv_id;
  geometry::Pose2 base_in_map;   // where the vehicle believed to be at the first ray
  double position_sigma_m{0.0};  // how sure it was: standard deviation of each axis; 0: it does not say
  double yaw_sigma_rad{0.0};
  geometry::Twist2 twist;       // constant during the sweep
  double first_angle_rad{0.0};  // in the vehicle's frame; counter-clockwise from there
  double angle_step_rad{0.0};
  double sweep_s{0.0};          // from the first ray to the last; 0: all at once
  double range_min_m{0.0};      // nearer is the vehicle itself: not used
  double range_max_m{10.0};     // this and more (infinity too): nothing was seen
  std::vector<float> ranges_m;  // one a ray, at most 1440
};

}  // namespace aisle::fleet
