#pragma once

#include "common/time/stamp.hpp"

namespace aisle::process {

/// Resident memory of this process in 10^6 bytes (/proc/self/statm); 0 where there is no /proc.
double resident_mb();

/// Computing time of this process, user and system.
time::Stamp cpu_time();

/// Share of one core that a process used between two calls, in percent (above 100 with several busy
/// threads).
class CpuMeter {
 public:
  /// `now`: monotonic; `cpu`: cpu_time() at that moment. 0 at the first call.
  double percent_since_last(time::Stamp now, time::Stamp cpu);

 private:
  bool started_{false};
  time::Stamp last_now_{};
  time::Stamp last_cpu_{};
};

}  // namespace aisle::process
