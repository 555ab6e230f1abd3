#pragma once

#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

/// Looks at a cell and the eight around it at once: four clearances of a row are compared in one instruction.
class Surroundings {
 public:
  explicit Surroundings(const Drivable& drivable)
      : drivable_(drivable),
        clearances_m_(drivable.clearances_m()),
        least_m_(drivable.least_m()),
        width_(static_cast<std::size_t>(drivable.geometry().width)),
        is_plain_(!drivable.has_tight_end()) {}

  /// Which of the nine are traversable: bit 0 the lower left, bit 2 the lower right, bit 8 the upper right one. Outside
  /// the grid nothing is. @pre index is that of `cell`, which is in the grid
  unsigned nine(std::size_t index, grid::Cell cell) const {
    const grid::Geometry& geometry = drivable_.geometry();
    const bool is_inner = cell.x > 0 && cell.y > 0 && cell.x + 2 < geometry.width && cell.y + 1 < geometry.height;
    if (!is_plain_ || !is_inner) return one_by_one(cell);

    const float* below = clearances_m_ + (index - width_ - 1);

    return three(below) | three(below + width_) << 3 | three(below + 2 * width_) << 6;
  }

 private:
  /// Bits of three neighbouring cells of a row. Reads a fourth one, which the caller knows to exist.
  unsigned three(const float* row) const {
#ifdef __SSE2__
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpge_ps(_mm_loadu_ps(row), _mm_set1_ps(least_m_)))) & 7U;
#else
    return (row[0] >= least_m_ ? 1U : 0U) | (row[1] >= least_m_ ? 2U : 0U) | (row[2] >= least_m_ ? 4U : 0U);
#endif
  }

  /// At the border, and near a tight end.
  unsigned one_by_one(grid::Cell cell) const {
    unsigned nine = 0;
    unsigned bit = 1;

    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
      for (int x = cell.x - 1; x <= cell.x + 1; ++x, bit <<= 1)
        nine |= drivable_.is_traversable(grid::Cell{x, y}) ? bit : 0U;
    }

    return nine;
  }

  const Drivable& drivable_;
  const float* clearances_m_;
  float least_m_;
  std::size_t width_;
  bool is_plain_;
};

}  // namespace aisle::global_planner
