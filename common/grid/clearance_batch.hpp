#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/geometry/batch.hpp"
#include "common/grid/between_centers.hpp"

namespace aisle::grid {

/// Looks up a clearance field at four points in map at once. Make one for a loop: it is small. @pre the
/// field outlives it and does not change
///
/// How: nearly all points lie between the centres of four free cells. Their clearance is the bilinear
/// lower bound of BetweenCenters, computed for four points without a branch. The others (beside
/// obstacles, on the lines between centres, outside the grid) are looked up one by one in the field
/// itself.
class ClearanceBatch {
 public:
  /// A grid of fewer than 2 x 2 cells has no four centres: all its points are looked up one by one.
  explicit ClearanceBatch(const ClearanceField& field);

  /// In metres; to the bit what `ClearanceField::clearance_m` says of each point that is `wanted`, and that or 0 of the
  /// others. The points may be anything, infinite too.
  [[gnu::always_inline]] geometry::Batch clearance_m(const geometry::Batch& x, const geometry::Batch& y,
                                                     const geometry::BatchMask& wanted) const {
    geometry::Batch clearance_m = between_free_cells_m(x, y);
    if (geometry::any(wanted & ~(clearance_m > 0.0))) look_up_others(x, y, wanted, clearance_m);
    return clearance_m;
  }

  /// A lower bound of `clearance_m` for a third of the work, less by at most two cells: the clearance of the centre of
  /// each point's own cell, less one cell. 0 outside the grid; may be negative.
  [[gnu::always_inline]] geometry::Batch rough_m(const geometry::Batch& x, const geometry::Batch& y) const {
    using geometry::Batch;
    const Batch u = (x - origin_x_) * cells_a_metre_, v = (y - origin_y_) * cells_a_metre_;
    const geometry::BatchMask is_inside = (u >= 0.0) & (v >= 0.0) & (u < columns_) & (v < rows_);
    const Indices index = index_of(is_inside ? u : Batch{}, is_inside ? v : Batch{});
    const Singles center_m{cells_m_[index[0]], cells_m_[index[1]], cells_m_[index[2]], cells_m_[index[3]]};

    return is_inside ? __builtin_convertvector(center_m, Batch) - cell_m_ : Batch{};
  }

  /// The same of one point.
  double rough_m(geometry::Point2 in_map) const;

 private:
  using Singles = float __attribute__((vector_size(4 * sizeof(float))));
  using Cells = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));
  using Indices = std::uint32_t __attribute__((vector_size(4 * sizeof(std::uint32_t))));
  using Pairs = float __attribute__((vector_size(8 * sizeof(float))));  // of neighbouring cells: left, right, left...
  using Sorted = double __attribute__((vector_size(8 * sizeof(double))));  // the four left ones, the four right ones

  /// Place in cells_m_ of the cells that hold (u, v), given in cells from the grid's corner. @pre
  /// inside the grid
  [[gnu::always_inline]] Indices index_of(const geometry::Batch& u, const geometry::Batch& v) const {
    const Cells column = __builtin_convertvector(u, Cells), row = __builtin_convertvector(v, Cells);
    return reinterpret_cast<Indices>(row * width_ + column);
  }

  /// 0 where one of the four cells is occupied, or the point lies on a line between centres or outside the grid.
  [[gnu::always_inline]] geometry::Batch between_free_cells_m(const geometry::Batch& x,
                                                              const geometry::Batch& y) const {
    using geometry::Batch;
    constexpr double kOnALine = 1e-8;  // cells: as near as this to a line, ClearanceField snaps to it
    const Batch u = (x - origin_x_) / cell_m_ - 0.5, v = (y - origin_y_) / cell_m_ - 0.5;
    const geometry::BatchMask is_inside = (u >= 0.0) & (v >= 0.0) & (u < last_u_) & (v < last_v_);
    const Batch known_u = is_inside ? u : Batch{}, known_v = is_inside ? v : Batch{};
    const Cells column = __builtin_convertvector(known_u, Cells), row = __builtin_convertvector(known_v, Cells);
    const auto index = reinterpret_cast<Indices>(row * width_ + column);
    const Batch s = known_u - __builtin_convertvector(column, Batch), t = known_v - __builtin_convertvector(row, Batch);

    Batch corner_m[4];
    gather(cells_m_, index, corner_m[0], corner_m[1]);
    gather(cells_m_ + width_, index, corner_m[2], corner_m[3]);

    const Batch between_m = BetweenCenters::between_free_m(corner_m, s, t, cell_m_);
    const geometry::BatchMask is_between =
        (s >= kOnALine) & (t >= kOnALine) & (s <= 1.0 - kOnALine) & (t <= 1.0 - kOnALine);

    return is_between ? between_m : Batch{};
  }

  /// Of each index's cell and the next one: a pair is loaded as one double.
  [[gnu::always_inline]] static void gather(const float* cells_m, const Indices& index, geometry::Batch& left_m,
                                            geometry::Batch& right_m) {
    geometry::Batch loaded;
    for (std::size_t i = 0; i < geometry::kBatch; ++i) {
      double pair;
      std::memcpy(&pair, cells_m + index[i], sizeof(pair));
      loaded[i] = pair;
    }

    const auto pairs = reinterpret_cast<Pairs>(loaded);
    const Sorted sorted =
        __builtin_convertvector(__builtin_shufflevector(pairs, pairs, 0, 2, 4, 6, 1, 3, 5, 7), Sorted);

    left_m = __builtin_shufflevector(sorted, sorted, 0, 1, 2, 3);
    right_m = __builtin_shufflevector(sorted, sorted, 4, 5, 6, 7);
  }

  /// Asks the field for the points that are `wanted` and whose `clearance_m` is still 0, one by one.
  void look_up_others(const geometry::Batch& x, const geometry::Batch& y, const geometry::BatchMask& wanted,
                      geometry::Batch& clearance_m) const;

  const ClearanceField& field_;
  const float* cells_m_;
  std::int32_t width_;
  double origin_x_, origin_y_, cell_m_;
  double last_u_, last_v_;  // the last centres, in cells from the first
  double cells_a_metre_, columns_, rows_;
};

}  // namespace aisle::grid
