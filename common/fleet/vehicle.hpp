#pragma once

#include <string>

#include "common/geometry/footprint.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::fleet {

/// What a vehicle is and what it can do. Does not change while its process runs.
struct Vehicle {
  std::string id;                 // "agv-1"
  geometry::Footprint footprint;  // outline around the vehicle's frame
  kinematics::Limits limits;      // with its kinematic model; magnitudes, m and s
  double sensor_range_m{0.0};     // of its lidar, 0 to 1000; 0: it has none
  double command_timeout_s{0.0};  // silence after which it brakes by itself, 0 to 60

  /// Radius of the circle around the frame's origin that holds the whole footprint.
  double reach_m() const { return geometry::reach_m(footprint); }

  /// Equal discs along the vehicle's axis that together cover the footprint.
  geometry::CoveringDiscs discs() const { return geometry::covering_discs(footprint); }

  /// A tricycle needs a turning circle; see kinematics::least_turning_radius_m.
  bool turns_on_the_spot() const { return limits.model != kinematics::Model::kTricycle; }
};

}  // namespace aisle::fleet
