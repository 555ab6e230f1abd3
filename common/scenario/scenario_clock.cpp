#include "common/scenario/scenario_clock.hpp"

namespace aisle::scenario {

ScenarioClock::ScenarioClock(std::vector<std::string> vehicle_ids, std::optional<std::int64_t> start_at_ns)
    : missing_(vehicle_ids.begin(), vehicle_ids.end()), start_at_ns_(start_at_ns) {}

void ScenarioClock::vehicle_heard(const std::string& vehicle_id, time::Stamp now, std::int64_t wall_clock_ns) {
  missing_.erase(vehicle_id);
  if (!missing_.empty() || start_at_ns_) return;
  start_at_ns_ = wall_clock_ns;
  zero_ = now;
}

std::optional<double> ScenarioClock::seconds(time::Stamp now, std::int64_t wall_clock_ns) {
  if (!zero_ && start_at_ns_) place(now, wall_clock_ns);
  if (!zero_) return std::nullopt;
  return time::seconds(now - *zero_);
}

/// zero = now + (start - wall clock): both clocks are read at the same moment.
void ScenarioClock::place(time::Stamp now, std::int64_t wall_clock_ns) {
  zero_ = now + time::Stamp(*start_at_ns_ - wall_clock_ns);
}

}  // namespace aisle::scenario
