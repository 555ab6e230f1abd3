#include "tools/cli/rates.hpp"

#include <algorithm>

namespace aisle::cli {

void Rate::add(time::Stamp arrived, std::size_t bytes) {
  if (samples_ == 0) {
    first_ = arrived;
  } else {
    longest_gap_ = std::max(longest_gap_, arrived - last_);
  }

  last_ = arrived;
  bytes_ += bytes;
  ++samples_;
}

double Rate::hz() const {
  const double span_s = time::seconds(last_ - first_);
  return samples_ < 2 || span_s <= 0.0 ? 0.0 : static_cast<double>(samples_ - 1) / span_s;
}

double Rate::mean_gap_ms() const { return hz() > 0.0 ? 1e3 / hz() : 0.0; }

}  // namespace aisle::cli
