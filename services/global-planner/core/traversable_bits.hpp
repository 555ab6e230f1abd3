#pragma once

#include <cstdint>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "services/global-planner/core/drivable.hpp"

namespace aisle::global_planner {

/// One bit a cell, 1 where the vehicle may be, along parallel lines of cells (rows, or columns), with blocked cells all
/// around. A jump along a line looks at 64 cells at once: block-based scanning (Harabor, Grastien, "Improving Jump
/// Point Search", 2014).
class BitLines {
 public:
  /// All cells blocked. `lines`: how many; `length`: cells in each.
  void resize(int lines, int length);

  /// 64 cells from `at` on, a multiple of 64; those beyond the line's end must be 0.
  void set(int line, int at, std::uint64_t cells) {
    words_[static_cast<std::size_t>(line + 1) * per_line_ + index(at)] = cells;
  }

  /// 64 cells from `at` on, a multiple of 64.
  std::uint64_t cells(int line, int at) const { return words(line)[index(at)]; }

  /// @pre 0 <= line < lines, 0 <= at < length
  bool is_open(int line, int at) const { return ((words(line)[index(at)] >> bit(at)) & 1U) != 0; }

  /// Where a scan along a line ends.
  struct Stop {
    int at;
    bool is_jump_point;  // else a blocked cell
  };

  /// From `at` on to the first blocked cell, or to the first open one at which a cell beside the line forces a turn:
  /// that cell is open, and the one before it in the direction of the scan is blocked. @pre is_open(line, at)
  Stop scan_up(int line, int at) const;

  /// The same downwards.
  Stop scan_down(int line, int at) const;

 private:
  static constexpr int kMargin = 64;
  static std::size_t index(int at) { return static_cast<std::size_t>(at + kMargin) >> 6; }
  static unsigned bit(int at) { return static_cast<unsigned>(at + kMargin) & 63U; }
  const std::uint64_t* words(int line) const { return words_.data() + static_cast<std::size_t>(line + 1) * per_line_; }

  std::size_t per_line_{0};
  std::vector<std::uint64_t> words_;
};

/// The traversable cells of one problem, by rows and by columns. Made anew only when the field or the radius differs
/// from those of the problem before; what a tight end changes is made and undone in blocks of 64 x 64 cells around it.
class TraversableBits {
 public:
  /// Makes the bits of this problem.
  void make(const Drivable& drivable);

  /// @pre the cell is in the map, and the bits were made
  bool is_open(grid::Cell c) const { return rows_.is_open(c.y, c.x); }
  const BitLines& rows() const { return rows_; }
  const BitLines& columns() const { return columns_; }

 private:
  /// Cells low.x..high.x-1, low.y..high.y-1.
  struct Window {
    grid::Cell low;   // included
    grid::Cell high;  // not included
  };

  enum class TightEnds { kLeftOut, kSeen };

  /// Fills the blocks that the window touches, rows and columns.
  void fill(const Drivable& drivable, const Window& window, TightEnds tight_ends);

  std::uint64_t field_revision_{0};
  float least_m_{-1.0F};
  BitLines rows_;
  BitLines columns_;
  std::vector<Window> tight_;  // where a tight end of the last problem may have changed bits
};

}  // namespace aisle::global_planner
