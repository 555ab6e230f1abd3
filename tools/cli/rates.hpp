#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "common/time/stamp.hpp"

namespace aisle::cli {

/// Rate and gaps of one instance's samples. Times are those of arrival, on one monotonic clock.
class Rate {
 public:
  /// One sample, in order of arrival; `bytes`: its payload.
  void add(time::Stamp arrived, std::size_t bytes);

  std::uint64_t samples() const { return samples_; }

  /// Gaps a second between first and last sample; 0 with fewer than two.
  double hz() const;

  /// Between two samples; the mean is 0 where hz() is.
  double mean_gap_ms() const;
  double longest_gap_ms() const { return time::seconds(longest_gap_) * 1e3; }

  /// A sample's payload.
  double mean_bytes() const {
    return samples_ == 0 ? 0.0 : static_cast<double>(bytes_) / static_cast<double>(samples_);
  }

  double bytes_per_s() const { return hz() * mean_bytes(); }

 private:
  std::uint64_t samples_{0};
  std::uint64_t bytes_{0};
  time::Stamp first_{};
  time::Stamp last_{};
  time::Stamp longest_gap_{};
};

using Rates = std::map<std::string, Rate>;

}  // namespace aisle::cli
