#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/traversable_bits.hpp"

namespace aisle::global_planner {

/// The parts of the map within which a vehicle can drive, but not from one to another, cutting no corner. Kept as runs
/// of traversable cells in a row, joined where they touch: union-find over runs, one pass over the map, 64 cells at
/// once, where a flood fill looks at every cell.
class ConnectedParts {
 public:
  /// Finds the parts for this field and radius; does nothing when is_made_for(drivable).
  void make(const Drivable& drivable);

  /// Were they made of this field, for this radius? Never when an end is tight, which holds for one problem only.
  bool is_made_for(const Drivable& drivable) const;

  /// True: there is surely no way from one to the other, as both are traversable, in different parts. @pre both in the
  /// map
  bool are_apart(grid::Cell a, grid::Cell b) const;

  /// The cell of the part in which `from` lies whose centre is nearest to the point; nothing when `from` is not
  /// traversable. @pre `from` is in the map; the point may lie anywhere
  std::optional<grid::Cell> nearest(grid::Cell from, geometry::Point2 to_in_map) const;

 private:
  /// Neighbouring traversable cells of one row.
  struct Run {
    int begin;           // x of the first cell
    int end;             // x after the last
    std::uint32_t part;  // index of a run of the same part; of the part's first run when all is made
  };

  /// Appends the runs of row y.
  void add_row(int y);

  /// Joins the runs of row y to those that they touch in row y - 1.
  void join_to_row_below(int y);

  /// Index of the first run of the part, as far as it is known.
  std::uint32_t first_of(std::uint32_t run);

  /// The run that holds the cell; null when it is not traversable.
  const Run* run_of(grid::Cell cell) const;

  grid::Geometry geometry_;
  std::uint64_t field_revision_{0};
  float least_m_{-1.0F};
  bool has_tight_end_{false};
  TraversableBits bits_;
  std::vector<Run> runs_;          // row by row from the bottom, from left to right
  std::vector<std::size_t> rows_;  // where each row's runs begin; one more at the end
};

}  // namespace aisle::global_planner
