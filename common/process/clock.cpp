#include "common/process/clock.hpp"

#include <chrono>

namespace aisle::process {

std::int64_t wall_clock_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace aisle::process
