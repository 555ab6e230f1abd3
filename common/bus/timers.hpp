#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "common/time/stamp.hpp"

namespace aisle::bus {

/// The timers of one loop, on the bus's monotonic clock. A loop that is late skips ticks: after a late tick comes the
/// next one of the same grid, not all that were missed. Timers of one period share a grid, so that one wake-up serves
/// all of them: the vehicles of a shared process cost one wake-up a cycle, not one each.
class Timers {
 public:
  static constexpr std::chrono::nanoseconds kShortestPeriod{1000};

  /// First one period after `now`; at most a period later where an earlier timer of this period has set the grid.
  void add(std::chrono::nanoseconds period, time::Stamp now, std::function<void()> handler) {
    const std::chrono::nanoseconds bounded = std::max(period, kShortestPeriod);
    timers_.push_back({bounded, first_tick(bounded, now + bounded), std::move(handler)});
  }

  /// Calls each handler that is due at `now`, once; handlers may add timers. True when there was one.
  bool handle(time::Stamp now) {
    bool handled = false;

    for (std::size_t i = 0; i < timers_.size(); ++i) {
      Timer& timer = timers_[i];
      if (timer.next > now) continue;

      const auto missed = (now - timer.next) / timer.period;
      timer.next += (missed + 1) * timer.period;
      timer.handler();
      handled = true;
    }

    return handled;
  }

  /// When the next handler is due; none without timers.
  std::optional<time::Stamp> next() const {
    std::optional<time::Stamp> first;
    for (const Timer& timer : timers_) first = first ? std::min(*first, timer.next) : timer.next;
    return first;
  }

  void clear() { timers_.clear(); }

 private:
  struct Timer {
    std::chrono::nanoseconds period;
    time::Stamp next;
    std::function<void()> handler;
  };

  /// The first instant of the period's grid that is not before `earliest`.
  time::Stamp first_tick(std::chrono::nanoseconds period, time::Stamp earliest) const {
    const auto alike =
        std::find_if(timers_.begin(), timers_.end(), [&](const Timer& timer) { return timer.period == period; });
    if (alike == timers_.end()) return earliest;

    const auto phase = (alike->next - earliest) % period;  // in (-period, period)
    return earliest + (phase.count() < 0 ? phase + period : phase);
  }

  std::deque<Timer> timers_;  // references stay good while handlers add more
};

}  // namespace aisle::bus
