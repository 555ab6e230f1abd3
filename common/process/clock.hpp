#pragma once
#include <cstdint>

#include "common/time/stamp.hpp"

namespace aisle::process {

/// This host's monotonic clock; what services pass to their cores as `now`.
time::Stamp monotonic_now();

/// Nanoseconds since the Unix epoch; for samples' stamps, people and figures, never for safety.
std::int64_t wall_clock_ns();

}  // namespace aisle::process
