#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace aisle::lab {

/// What two samples say that were measured on the same maps or drives, one pair a map.
struct PairedComparison {
  std::size_t n{0};
  double mean_a{0.0};
  double mean_b{0.0};
  double mean_difference{0.0};  // of b minus a
  /// In which the true mean difference lies with 95 % confidence, by Student's t; of no width for fewer than two pairs.
  std::array<double, 2> interval95{};
  /// Two-sided, of Wilcoxon's signed-rank test: how likely ranks are as uneven as these when neither is greater.
  double wilcoxon_p{1.0};
  /// Matched-pairs rank-biserial correlation: 1 when b is greater in every pair, -1 when a is, 0 when neither.
  double effect{0.0};

  bool interval_excludes_zero() const { return interval95[0] > 0.0 || interval95[1] < 0.0; }
};

/// @pre as many of a as of b
PairedComparison compare_pairs(const std::vector<double>& a, const std::vector<double>& b);

/// The 97.5 % quantile of Student's t with this many degrees of freedom, within 0.1 % from three on (Abramowitz and
/// Stegun 26.7.5).
double student_t_975(std::size_t degrees_of_freedom);

}  // namespace aisle::lab
