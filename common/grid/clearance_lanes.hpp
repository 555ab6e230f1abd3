#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "common/geometry/wide_vectors.hpp"
#include "common/grid/between_centers.hpp"

namespace aisle::grid {

/// `ClearanceField::clearance_m` of four points in map at once; to the bit what it says of each, several times as fast.
/// Made for a loop: it is small. @pre the field lives as long
class ClearanceLanes {
 public:
  explicit ClearanceLanes(const ClearanceField& field);

  /// In metres; 0 may be said of points that are not `wanted`. The points may be anything, infinite too.
  [[gnu::always_inline]] void find_m(const geometry::Wide& x, const geometry::Wide& y,
                                     const geometry::WideMarks& wanted, geometry::Wide& clearance_m) const {
    find_usual_m(x, y, clearance_m);
    if (geometry::is_any(wanted & ~(clearance_m > 0.0))) find_others_m(x, y, wanted, clearance_m);
  }

  /// No more than `find_m` says, and less by at most two cells: what the centre of each point's own cell has, less a
  /// cell. A third of the work. 0 or less outside the grid and near obstacles.
  [[gnu::always_inline]] void find_at_least_m(const geometry::Wide& x, const geometry::Wide& y,
                                              geometry::Wide& at_least_m) const {
    using geometry::Wide;
    const Wide u = (x - origin_x_) * cells_a_metre_, v = (y - origin_y_) * cells_a_metre_;
    const geometry::WideMarks is_inside = (u >= 0.0) & (v >= 0.0) & (u < columns_) & (v < rows_);
    const Cells column = __builtin_convertvector(is_inside ? u : Wide{}, Cells),
                row = __builtin_convertvector(is_inside ? v : Wide{}, Cells);
    const auto index = reinterpret_cast<Indices>(row * width_ + column);
    const Four center_m{cells_m_[index[0]], cells_m_[index[1]], cells_m_[index[2]], cells_m_[index[3]]};
    at_least_m = is_inside ? __builtin_convertvector(center_m, Wide) - cell_m_ : Wide{};
  }

 private:
  using Four = float __attribute__((vector_size(16)));
  using Cells = std::int32_t __attribute__((vector_size(16)));
  using Indices = std::uint32_t __attribute__((vector_size(16)));
  using Corners = float __attribute__((vector_size(32)));  // pairs of left and right
  using Sorted = double __attribute__((vector_size(64)));  // all left, all right

  /// The usual case: four free cells around a point that lies on no line of centres. Otherwise 0.
  [[gnu::always_inline]] void find_usual_m(const geometry::Wide& x, const geometry::Wide& y,
                                           geometry::Wide& clearance_m) const {
    using geometry::Wide;
    using geometry::WideMarks;
    constexpr double kOnALine = 1e-8;  // or nearly: snapping is not done here
    const Wide u = (x - origin_x_) / cell_m_ - 0.5;
    const Wide v = (y - origin_y_) / cell_m_ - 0.5;
    const WideMarks is_inside = (u >= 0.0) & (v >= 0.0) & (u < last_u_) & (v < last_v_);
    const Wide known_u = is_inside ? u : Wide{};
    const Wide known_v = is_inside ? v : Wide{};
    const Cells column = __builtin_convertvector(known_u, Cells), row = __builtin_convertvector(known_v, Cells);
    const auto index = reinterpret_cast<Indices>(row * width_ + column);
    const Wide s =
        known_u - __builtin_convertvector(column, Wide);  // 0 where the point is not between four cells of the grid
    const Wide t = known_v - __builtin_convertvector(row, Wide);
    Wide corner_m[4], between_m;
    gather(cells_m_, index, corner_m[0], corner_m[1]);
    gather(cells_m_ + width_, index, corner_m[2], corner_m[3]);
    BetweenCenters::find_clearance_m(corner_m, s, t, cell_m_, between_m);
    const WideMarks is_between = (s >= kOnALine) & (t >= kOnALine) & (s <= 1.0 - kOnALine) & (t <= 1.0 - kOnALine);
    clearance_m = is_between ? between_m : Wide{};
  }

  /// Of each index's cell and the next one.
  [[gnu::always_inline]] static void gather(const float* cells_m, const Indices& index, geometry::Wide& left_m,
                                            geometry::Wide& right_m) {
    geometry::Wide pairs;
    for (std::size_t i = 0; i < geometry::kWide; ++i) {
      double pair;
      std::memcpy(&pair, cells_m + index[i], sizeof(pair));
      pairs[i] = pair;
    }
    const auto corners = reinterpret_cast<Corners>(pairs);
    const Sorted sorted =
        __builtin_convertvector(__builtin_shufflevector(corners, corners, 0, 2, 4, 6, 1, 3, 5, 7), Sorted);
    left_m = __builtin_shufflevector(sorted, sorted, 0, 1, 2, 3);
    right_m = __builtin_shufflevector(sorted, sorted, 4, 5, 6, 7);
  }

  /// One by one, of those that are wanted and not known.
  void find_others_m(const geometry::Wide& x, const geometry::Wide& y, const geometry::WideMarks& wanted,
                     geometry::Wide& clearance_m) const;

  const ClearanceField& field_;
  const float* cells_m_;
  std::int32_t width_;
  double origin_x_, origin_y_, cell_m_;
  double last_u_, last_v_;  // the last centres, in cells from the first
  double cells_a_metre_, columns_, rows_;
};

}  // namespace aisle::grid
