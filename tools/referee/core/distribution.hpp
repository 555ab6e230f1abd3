#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace aisle::referee {

/// Values of one figure; quantiles by nearest rank, so each is a value that was seen.
class Distribution {
 public:
  void add(double value) { values_.push_back(value); }
  void add_all(const Distribution& other) { values_.insert(values_.end(), other.values_.begin(), other.values_.end()); }
  std::size_t count() const { return values_.size(); }

  /// Nothing when no value was seen. @pre 0 < share <= 1
  std::optional<double> quantile(double share) const {
    if (values_.empty()) return std::nullopt;

    std::vector<double> sorted = values_;
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);

    std::nth_element(sorted.begin(), nth, sorted.end());
    return *nth;
  }

  std::optional<double> max() const {
    return values_.empty() ? std::nullopt : std::optional<double>(*std::max_element(values_.begin(), values_.end()));
  }

 private:
  std::vector<double> values_;
};

}  // namespace aisle::referee
