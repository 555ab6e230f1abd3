#pragma once

// Samples of idl/vehicle.idl to and from the values of common/fleet. Encoders leave `by` to the writer.

#include "common/fleet/obstacle.hpp"
#include "common/fleet/scan.hpp"
#include "common/fleet/vehicle.hpp"
#include "common/fleet/vehicle_state.hpp"
#include "common/fleet/velocity_command.hpp"
#include "common/wire/checks.hpp"
#include "idl/vehicle.hpp"

namespace aisle::wire {

aisle::VehicleInfo encode(const fleet::Vehicle& vehicle);

/// The circle that the sample says is believed of a disc only; that around a rectangle follows from its lengths. The
/// steered axle is looked at of a tricycle only.
Decoded<fleet::Vehicle> decode(const aisle::VehicleInfo& sample);

aisle::VehicleState encode(const fleet::VehicleState& state);
Decoded<fleet::VehicleState> decode(const aisle::VehicleState& sample);

aisle::Scan encode(const fleet::Scan& scan);

/// Checks id and size; the numbers are the tracker's to judge.
Decoded<fleet::Scan> decode(const aisle::Scan& sample);

aisle::VelocityCommand encode(const fleet::VelocityCommand& command);
Decoded<fleet::VelocityCommand> decode(const aisle::VelocityCommand& sample);

aisle::WorldObstacle encode(const fleet::Obstacle& obstacle);
Decoded<fleet::Obstacle> decode(const aisle::WorldObstacle& sample);

}  // namespace aisle::wire
