#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/time/stamp.hpp"

namespace aisle::scenario {

/// Second zero of a run, by the same rule in every process: the moment at which the last of the
/// scenario's vehicles was heard, or the given `start_at_ns` (Unix epoch), whichever is known. The wall
/// clock is read once, to place second zero on the monotonic clock; a later jump of it does not move
/// the run.
///
///     waiting ──(all vehicles heard, or start_at_ns known)──► running
class ScenarioClock {
 public:
  /// `start_at_ns`: Unix epoch; none: the run begins when all vehicles were heard.
  ScenarioClock(std::vector<std::string> vehicle_ids, std::optional<std::int64_t> start_at_ns);

  /// A vehicle was heard at `now` (monotonic) and `wall_clock_ns` (Unix epoch).
  void vehicle_heard(const std::string& vehicle_id, time::Stamp now, std::int64_t wall_clock_ns);

  /// Seconds since second zero (negative before a `start_at_ns` to come); none while waiting.
  std::optional<double> seconds(time::Stamp now, std::int64_t wall_clock_ns);

  /// Second zero in Unix time, to be kept for a process that restarts; none while waiting.
  std::optional<std::int64_t> started_at_ns() const { return start_at_ns_; }

  /// Vehicles that were not heard yet, for `waits_for`.
  std::vector<std::string> missing() const { return {missing_.begin(), missing_.end()}; }

 private:
  /// Finds second zero on the monotonic clock.
  void place(time::Stamp now, std::int64_t wall_clock_ns);

  std::set<std::string> missing_;
  std::optional<std::int64_t> start_at_ns_;
  std::optional<time::Stamp> zero_;
};

}  // namespace aisle::scenario
