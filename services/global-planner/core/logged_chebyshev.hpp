#pragma once
#include <cmath>
#include <cstdlib>
#include <vector>

#include "services/global-planner/core/best_first.hpp"

namespace aisle::global_planner {

/// lg(h + 1) h of WANG (eq. 4), in cells, h the Chebyshev distance to the goal and in metres under the logarithm. lg is
/// log10: below 9 m it makes the heuristic weaker on purpose, so that the search widens near the goal. From a table,
/// made once for maps of one size.
class LoggedChebyshev {
 public:
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    const auto longest = static_cast<std::size_t>(std::max(ends.geometry.width, ends.geometry.height));
    if (table_.size() == longest && resolution_m_ == ends.geometry.resolution_m) return;
    resolution_m_ = ends.geometry.resolution_m;
    table_.resize(longest);
    for (std::size_t cells = 0; cells < longest; ++cells) {
      const auto h = static_cast<double>(cells);
      table_[cells] = static_cast<float>(std::log10(h * resolution_m_ + 1.0) * h);
    }
  }

  float operator()(grid::Cell cell) const {
    return table_[static_cast<std::size_t>(std::max(std::abs(cell.x - goal_.x), std::abs(cell.y - goal_.y)))];
  }

 private:
  grid::Cell goal_;
  double resolution_m_{0.0};
  std::vector<float> table_;
};

}  // namespace aisle::global_planner
