#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace aisle::global_planner {

/// How long the newest slices of work took.
class SliceTimes {
 public:
  void add(double took_ms) {
    newest_ms_[next_ % newest_ms_.size()] = took_ms;
    ++next_;
  }

  /// 99 of 100 of the newest slices took no longer; 0: there was none.
  double p99_ms() const {
    const std::size_t count = std::min(next_, newest_ms_.size());
    if (count == 0) return 0.0;

    std::array<double, kKept> sorted_ms = newest_ms_;
    const auto end = sorted_ms.begin() + static_cast<std::ptrdiff_t>(count);
    const auto at = sorted_ms.begin() + static_cast<std::ptrdiff_t>((count - 1) * 99 / 100);
    std::nth_element(sorted_ms.begin(), at, end);

    return *at;
  }

 private:
  static constexpr std::size_t kKept = 1000;

  std::array<double, kKept> newest_ms_{};
  std::size_t next_{0};
};

}  // namespace aisle::global_planner
