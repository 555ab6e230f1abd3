#include "services/global-planner/core/traversable_bits.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace aisle::global_planner {

// A word of margin at both ends of a line, and a line of margin on both sides, all blocked: scans stop there without
// looking at the border.
void BitLines::resize(int lines, int length) {
  per_line_ = static_cast<std::size_t>(length + 63) / 64 + 2;
  words_.assign((static_cast<std::size_t>(lines) + 2) * per_line_, 0);
}

BitLines::Stop BitLines::scan_up(int line, int at) const {
  const std::uint64_t* here = words(line);
  const std::uint64_t* left = here - per_line_;
  const std::uint64_t* right = here + per_line_;
  std::size_t i = index(at);

  // A turn is forced at an open cell of a line beside this one when the cell before it is blocked. In bits: open and
  // not (open shifted by one), where the bit that is shifted in comes from the word before.
  std::uint64_t forced = (left[i] & ~(left[i] << 1)) | (right[i] & ~(right[i] << 1));

  // Within the first word only the cells beyond `at` count.
  std::uint64_t stop = (~here[i] | forced) & (~std::uint64_t{1} << bit(at));
  while (stop == 0) {
    ++i;
    forced = (left[i] & ~(left[i] << 1 | left[i - 1] >> 63)) | (right[i] & ~(right[i] << 1 | right[i - 1] >> 63));
    stop = ~here[i] | forced;
  }

  const int first = __builtin_ctzll(stop);
  return {static_cast<int>(i << 6) + first - kMargin, ((here[i] >> first) & 1U) != 0};
}

// As scan_up(), with all shifts the other way round.
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

namespace {

using Block = std::array<std::uint64_t, 64>;

/// Bit x of word y becomes bit y of word x: swaps quarters, then quarters of these, and so on (Warren, "Hacker's
/// Delight", 7-3).
void transpose(Block& block) {
  std::uint64_t mask = 0x00000000FFFFFFFFU;
  for (unsigned shift = 32; shift != 0; shift >>= 1U, mask ^= mask << shift) {
    for (unsigned k = 0; k < 64; k = ((k | shift) + 1U) & ~shift) {
      const std::uint64_t swapped = ((block[k] >> shift) ^ block[k | shift]) & mask;
      block[k] ^= swapped << shift;
      block[k | shift] ^= swapped;
    }
  }
}

/// One bit for each of `count` cells of a row, at most 64: is its clearance at least `least_m`? Tight ends are not
/// looked at.
std::uint64_t wide_cells(const float* clearances_m, float least_m, int count) {
  std::uint64_t word = 0;
  int i = 0;
#ifdef __SSE2__
  for (const __m128 least = _mm_set1_ps(least_m); i + 4 <= count; i += 4) {
    word |= static_cast<std::uint64_t>(_mm_movemask_ps(_mm_cmpge_ps(_mm_loadu_ps(clearances_m + i), least)))
            << static_cast<unsigned>(i);
  }
#endif
  for (; i < count; ++i) word |= static_cast<std::uint64_t>(clearances_m[i] >= least_m) << static_cast<unsigned>(i);

  return word;
}

/// The same for cells near a tight end, one by one.
std::uint64_t cells_with_tight_ends(const Drivable& drivable, grid::Cell first, int count) {
  const std::size_t index = drivable.geometry().index(first);
  std::uint64_t word = 0;
  for (int i = 0; i < count; ++i) {
    word |=
        static_cast<std::uint64_t>(drivable.is_traversable(index + static_cast<std::size_t>(i), {first.x + i, first.y}))
        << static_cast<unsigned>(i);
  }

  return word;
}

}  // namespace

void TraversableBits::make(const Drivable& drivable) {
  const grid::Geometry& geometry = drivable.geometry();

  // The whole map when it is another one; else only the windows that the last problem's tight ends had changed.
  if (field_revision_ != drivable.field_revision() || least_m_ != drivable.least_m()) {
    rows_.resize(geometry.height, geometry.width);
    columns_.resize(geometry.width, geometry.height);
    fill(drivable, {{0, 0}, {geometry.width, geometry.height}}, TightEnds::kLeftOut);
    field_revision_ = drivable.field_revision();
    least_m_ = drivable.least_m();
  } else {
    for (const Window& window : tight_) fill(drivable, window, TightEnds::kLeftOut);
  }

  tight_.clear();

  // The windows around this problem's tight ends.
  for (const TightEnd* end : {&drivable.start(), &drivable.goal()}) {
    if (!(end->range_m > 0.0)) continue;
    const int reach =
        1 + static_cast<int>(std::min<double>(end->range_m / geometry.resolution_m, geometry.width + geometry.height));

    const grid::Cell middle = geometry.cell_at(end->center_in_map);
    tight_.push_back(
        {{std::max(0, middle.x - reach), std::max(0, middle.y - reach)},
         {std::min(geometry.width, middle.x + reach + 1), std::min(geometry.height, middle.y + reach + 1)}});
    fill(drivable, tight_.back(), TightEnds::kSeen);
  }
}

void TraversableBits::fill(const Drivable& drivable, const Window& window, TightEnds tight_ends) {
  const grid::Geometry& geometry = drivable.geometry();
  for (int y0 = window.low.y & ~63; y0 < window.high.y; y0 += 64) {
    for (int x0 = window.low.x & ~63; x0 < window.high.x; x0 += 64) {
      const int width = std::min(64, geometry.width - x0);
      const int height = std::min(64, geometry.height - y0);

      Block block{};

      // Rows as they lie in memory; their transpose are the columns.
      for (int y = 0; y < height; ++y) {
        const grid::Cell first{x0, y0 + y};
        std::uint64_t& word = block[static_cast<std::size_t>(y)];

        word = tight_ends == TightEnds::kSeen
                   ? cells_with_tight_ends(drivable, first, width)
                   : wide_cells(drivable.clearances_m() + geometry.index(first), drivable.least_m(), width);
        rows_.set(y0 + y, x0, word);
      }

      transpose(block);
      for (int x = 0; x < width; ++x) columns_.set(x0 + x, y0, block[static_cast<std::size_t>(x)]);
    }
  }
}

}  // namespace aisle::global_planner
