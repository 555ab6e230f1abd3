#pragma once

// Samples of idl/service.idl to and from the values of common/fleet. Encoders leave `by` to the writer.

#include "common/fleet/health.hpp"
#include "common/wire/checks.hpp"
#include "idl/service.hpp"

namespace aisle::wire {

/// Of more than 32 counters the first are written.
aisle::ServiceHealth encode(const fleet::ServiceHealth& health);
Decoded<fleet::ServiceHealth> decode(const aisle::ServiceHealth& sample);

}  // namespace aisle::wire
