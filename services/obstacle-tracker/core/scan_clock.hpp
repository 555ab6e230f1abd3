#pragma once
#include <cstdint>
#include <optional>
#include <variant>

#include "common/time/stamp.hpp"
#include "services/obstacle-tracker/core/scan.hpp"

namespace aisle::obstacle_tracker {

/// Puts one vehicle's stamps (its own wall clock) on the receiver's monotonic clock.
///
/// The clocks differ by an unknown offset, and a scan cannot arrive before it was measured; so the least
/// (arrival - stamp) seen lately is the offset plus the shortest transport, a few hundred microseconds. The moment of
/// measurement is stamp + that offset: free of the jitter of the way, and blind to the skew between two hosts.
/// A stamp more than `jump` off that line is refused, by reason; when `refusals` in a row lie on one new line, the
/// sender's clock was set, and the new line is taken: a clock that jumps costs 3 scans, not the sensor.
class ScanClock {
 public:
  /// The moment of measurement, never after `arrived`; or why the scan is refused. Stamps must rise.
  std::variant<time::Stamp, DropReason> place(std::int64_t stamp_ns, time::Stamp arrived);

 private:
  bool is_new_line(time::Stamp offset);
  void take(time::Stamp offset, time::Stamp arrived);

  std::optional<time::Stamp> offset_;  // arrival - stamp
  time::Stamp next_offset_{};          // the least of the window that is filling
  time::Stamp window_began_{};
  std::int64_t newest_stamp_ns_{0};
  time::Stamp refused_offset_{};
  int refusals_{0};
};

}  // namespace aisle::obstacle_tracker
