#pragma once

// Samples of idl/traffic.idl to and from the values of common/fleet. Encoders leave `by` to the writer.

#include "common/fleet/grant.hpp"
#include "common/fleet/sign_off.hpp"
#include "common/fleet/traffic_status.hpp"
#include "common/wire/checks.hpp"
#include "idl/traffic.hpp"

namespace aisle::wire {

/// Of more than 32 extra widths and 16 vehicles waited for, the first are written.
aisle::Grant encode(const fleet::Grant& grant);
Decoded<fleet::Grant> decode(const aisle::Grant& sample);

aisle::SignOff encode(const fleet::SignOff& sign_off);
Decoded<fleet::SignOff> decode(const aisle::SignOff& sample);

/// Of more than 128 waiting and 128 silent vehicles, the first are written.
aisle::TrafficStatus encode(const fleet::TrafficStatus& status);
Decoded<fleet::TrafficStatus> decode(const aisle::TrafficStatus& sample);

}  // namespace aisle::wire
