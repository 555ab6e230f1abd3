#pragma once

#include <chrono>

#include "common/time/stamp.hpp"

namespace aisle::bus {

/// This host's monotonic clock: DdsBus::now(), and the arrival of samples.
inline time::Stamp monotonic_now() {
  return std::chrono::duration_cast<time::Stamp>(std::chrono::steady_clock::now().time_since_epoch());
}

}  // namespace aisle::bus
