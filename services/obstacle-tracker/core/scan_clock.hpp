#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "common/time/stamp.hpp"
#include "services/obstacle-tracker/core/scan.hpp"

namespace aisle::obstacle_tracker {

/// Puts one vehicle's stamps (its own wall clock) on the receiver's monotonic clock.
///
/// The clocks differ by an unknown offset, and a scan cannot arrive before it was measured. So the least
/// (arrival - stamp) of the last 10 to 20 s is the offset plus the shortest transport, a few hundred microseconds:
///
///   moment of measurement = stamp + min(arrival - stamp)
///
/// free of the jitter of the way, and blind to the skew between two hosts. A stamp too far off that line (more than 1 s
/// late, or 0.2 s early) is refused, with the reason. When 3 refusals in a row lie on one new line, the sender's clock
/// was set, and the new line is taken: a clock that jumps costs 3 scans, not the sensor.
class ScanClock {
 public:
  /// The moment of measurement on the receiver's clock, never after `arrived`; or why the scan is refused. Stamps must
  /// rise from call to call. `stamp_ns`: nanoseconds of the sender's clock, from any origin.
  std::variant<time::Stamp, DropReason> place(std::int64_t stamp_ns, time::Stamp arrived);

 private:
  /// Counts a refused offset; true when enough of them agree.
  bool is_new_line(time::Stamp offset);

  /// Takes the offset into the least of its window, and begins a new window when the old one is full.
  void take(time::Stamp offset, time::Stamp arrived);

  std::optional<time::Stamp> offset_;  // the least arrival - stamp
  time::Stamp next_offset_{};          // the least of the window that is filling
  time::Stamp window_began_{};
  std::int64_t newest_stamp_ns_{0};

  time::Stamp refused_offset_{};
  int refusals_{0};
};

}  // namespace aisle::obstacle_tracker
