#include "common/process/clock.hpp"

#include <chrono>

namespace aisle::process {

time::Stamp monotonic_now() {
  return std::chrono::duration_cast<time::Stamp>(std::chrono::steady_clock::now().time_since_epoch());
}

std::int64_t wall_clock_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace aisle::process
