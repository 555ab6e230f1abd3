#pragma once
#include <cmath>
#include <cstdlib>
#include <type_traits>
#include <vector>

#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/parameters.hpp"

namespace aisle::global_planner {

/// lg(h + 1) h of WANG (eq. 4), in cells; h is the distance to the goal (WANG: Chebyshev), in metres under the
/// logarithm. lg is log10: below 9 m it makes the heuristic weaker on purpose, so that the search widens near the goal.
/// For the Chebyshev distance from a table, made once for maps of one size.
template <class Distance>
class LoggedDistance {
 public:
  explicit LoggedDistance(double log_base) : per_log_(1.0 / std::log10(log_base)) {}

  void begin(const Ends& ends) {
    goal_ = ends.goal;
    const auto longest = static_cast<std::size_t>(std::max(ends.geometry.width, ends.geometry.height));
    if (table_.size() == longest && resolution_m_ == ends.geometry.resolution_m) return;
    resolution_m_ = ends.geometry.resolution_m;
    table_.resize(longest);
    for (std::size_t cells = 0; cells < longest; ++cells) table_[cells] = logged(static_cast<double>(cells));
  }

  float operator()(grid::Cell cell) const {
    if constexpr (std::is_same_v<Distance, Chebyshev>)
      return table_[static_cast<std::size_t>(std::max(std::abs(cell.x - goal_.x), std::abs(cell.y - goal_.y)))];
    return logged(static_cast<double>(Distance::cells(cell, goal_)));
  }

 private:
  float logged(double h_cells) const {
    return static_cast<float>(std::log10(h_cells * resolution_m_ + 1.0) * per_log_ * h_cells);
  }

  double per_log_;
  grid::Cell goal_;
  double resolution_m_{0.0};
  std::vector<float> table_;
};

/// Reads the parameter `log_base`.
inline double log_base_of(Parameters& parameters) {
  return parameters.number("log_base", 10.0, 1.1, 1000.0, "of the logarithm that weakens h, WANG eq. 4");
}

}  // namespace aisle::global_planner
