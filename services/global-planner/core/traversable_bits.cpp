#include "services/global-planner/core/traversable_bits.hpp"

namespace aisle::global_planner {

void BitLines::resize(int lines, int length) {
  per_line_ = static_cast<std::size_t>(length + 63) / 64 + 2;
  words_.assign((static_cast<std::size_t>(lines) + 2) * per_line_, 0);
}

BitLines::Stop BitLines::scan_up(int line, int at) const {
  const std::uint64_t* here = words(line);
  const std::uint64_t* left = here - per_line_;
  const std::uint64_t* right = here + per_line_;
  std::size_t i = index(at);
  // A turn is forced at an open cell of a line beside this one whose forerunner is blocked.
  std::uint64_t forced = (left[i] & ~(left[i] << 1)) | (right[i] & ~(right[i] << 1));
  std::uint64_t stop = (~here[i] | forced) & (~std::uint64_t{1} << bit(at));
  while (stop == 0) {
    ++i;
    forced = (left[i] & ~(left[i] << 1 | left[i - 1] >> 63)) | (right[i] & ~(right[i] << 1 | right[i - 1] >> 63));
    stop = ~here[i] | forced;
  }
  const int first = __builtin_ctzll(stop);
  return {static_cast<int>(i << 6) + first - kMargin, ((here[i] >> first) & 1U) != 0};
}

BitLines::Stop BitLines::scan_down(int line, int at) const {
  const std::uint64_t* here = words(line);
  const std::uint64_t* left = here - per_line_;
  const std::uint64_t* right = here + per_line_;
  std::size_t i = index(at);
  std::uint64_t forced = (left[i] & ~(left[i] >> 1)) | (right[i] & ~(right[i] >> 1));
  std::uint64_t stop = (~here[i] | forced) & ((std::uint64_t{1} << bit(at)) - 1);
  while (stop == 0) {
    --i;
    forced = (left[i] & ~(left[i] >> 1 | left[i + 1] << 63)) | (right[i] & ~(right[i] >> 1 | right[i + 1] << 63));
    stop = ~here[i] | forced;
  }
  const int first = 63 - __builtin_clzll(stop);
  return {static_cast<int>(i << 6) + first - kMargin, ((here[i] >> first) & 1U) != 0};
}

void TraversableBits::make(const Drivable& drivable) {
  if (!drivable.has_tight_end() && field_revision_ == drivable.field_revision() && least_m_ == drivable.least_m()) return;
  const grid::Geometry& geometry = drivable.geometry();
  rows_.resize(geometry.height, geometry.width);
  columns_.resize(geometry.width, geometry.height);
  std::size_t index = 0;
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x, ++index) {
      if (!drivable.is_traversable(index, {x, y})) continue;
      rows_.set(y, x);
      columns_.set(x, y);
    }
  }
  field_revision_ = drivable.has_tight_end() ? 0 : drivable.field_revision();
  least_m_ = drivable.least_m();
}

}  // namespace aisle::global_planner
