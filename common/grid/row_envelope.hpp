#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace aisle::grid {

/// The lower envelope of parabolas over one row of cells (Felzenszwalb, Huttenlocher 2012): the step
/// along rows of an exact Euclidean distance transform. A site stands on a border between two cells of
/// the row, with the squared distance to the nearest obstacle in its column as its height.
///
/// Lengths are whole numbers of half cells and squared lengths their squares, so that all arithmetic is
/// exact. From the centre of cell x it is 2 (x - j) + 1 half cells to border j:
///
///     d^2(x) = min over sites j of (2 (x - j) + 1)^2 + height_j
class RowEnvelope {
 public:
  /// For rows of at most `width` cells.
  explicit RowEnvelope(int width)
      : site_(static_cast<std::size_t>(width) + 1), height_(site_.size()), begin_(site_.size()) {}

  /// Removes all sites.
  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }

  /// Adds the site on border `j`, which lies left of cell `j`. @pre `j` is greater than that of each
  /// site before
  ///
  /// How: sites that the new one beats from their first cell on are taken off the end; the last that is
  /// left keeps the cells up to where the new one becomes nearer.
  void add(std::int32_t j, std::int64_t height) {
    while (count_ > 0) {
      const std::int32_t begin = first_better(site_[count_ - 1], height_[count_ - 1], j, height);
      if (begin > begin_[count_ - 1]) {
        push(j, height, begin);
        return;
      }

      --count_;
    }

    push(j, height, 0);
  }

  /// Writes to `out` the squared distance in half cells from the centres of the cells x0 to x1-1 to the
  /// nearest site, but only where that is less than what stands there. out[0] is of cell x0.
  void lower(std::int32_t x0, std::int32_t x1, double* out) const {
    const auto later = std::upper_bound(begin_.begin(), begin_.begin() + static_cast<std::ptrdiff_t>(count_), x0);
    for (auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, later - begin_.begin() - 1)); k < count_; ++k) {
      const std::int32_t begin = std::max(x0, begin_[k]);
      const std::int32_t end = k + 1 < count_ ? std::min(x1, begin_[k + 1]) : x1;
      if (begin >= x1) return;

      const auto height = static_cast<double>(height_[k]);
      for (std::int32_t x = begin; x < end; ++x) {
        const double across = 2 * (x - site_[k]) + 1;
        out[x - x0] = std::min(out[x - x0], across * across + height);
      }
    }
  }

 private:
  void push(std::int32_t j, std::int64_t height, std::int32_t begin) {
    site_[count_] = j;
    height_[count_] = height;
    begin_[count_++] = begin;
  }

  /// The first cell that is nearer to the later site b than to a: (2(x-a)+1)^2 + A > (2(x-b)+1)^2 + B.
  static std::int32_t first_better(std::int32_t a, std::int64_t height_a, std::int32_t b, std::int64_t height_b) {
    const std::int64_t gap = b - a;
    const std::int64_t top = height_b - height_a + 4 * gap * (static_cast<std::int64_t>(a) + b - 1);
    if (top < 0) return 0;

    // A double holds both exactly, and the quotient is nearer to a whole number than rounding can tell only when it is
    // one.
    return static_cast<std::int32_t>(static_cast<double>(top) / static_cast<double>(8 * gap)) + 1;
  }

  std::vector<std::int32_t> site_;
  std::vector<std::int64_t> height_;
  std::vector<std::int32_t> begin_;
  std::size_t count_{0};
};

}  // namespace aisle::grid
