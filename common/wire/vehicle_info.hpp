#pragma once
// Samples of VehicleInfo (idl/vehicle.idl), what a vehicle is and can do, to and from our own types. The services share
// it.
#include <string>

#include "common/geometry/footprint.hpp"
#include "common/kinematics/limits.hpp"
#include "common/wire/checks.hpp"
#include "idl/vehicle.hpp"

namespace aisle::wire {

struct VehicleInfo {
  std::string agv_id;
  geometry::Footprint footprint;  // around the vehicle's frame
  kinematics::Limits limits;      // with its model
  double sensor_range_m{0.0};
  double command_timeout_s{0.0};
};

/// `by` is left to the writer.
aisle::VehicleInfo encode(const VehicleInfo& vehicle);

/// The circle that the sample says is believed of a disc only; that around a rectangle follows from its lengths. The
/// steered axle is looked at of a tricycle only.
Decoded<VehicleInfo> decode(const aisle::VehicleInfo& sample);

}  // namespace aisle::wire
