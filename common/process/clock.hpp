#pragma once

#include <cstdint>

namespace aisle::process {

/// Nanoseconds since the Unix epoch; for samples' stamps, people and figures, never for safety.
std::int64_t wall_clock_ns();

}  // namespace aisle::process
