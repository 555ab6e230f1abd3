#pragma once

#include <optional>

#include "common/grid/clearance.hpp"

namespace aisle::grid {

/// The cell that stopped a line, if one is known that surely did. It stops all lines from the same
/// point that end in its shadow, and this shadow is convex: a cell that stops the lines to two ends
/// stops those to all points between.
class Blocker {
 public:
  Blocker() = default;

  /// None, when there is no cell.
  explicit Blocker(std::optional<Cell> cell) : cell_(cell) {}

  /// True only when a disc of this radius surely touches the cell on the segment. Valid as long as the
  /// field does not change.
  bool blocks(const Geometry& geometry, geometry::Point2 from_in_map, geometry::Point2 to_in_map,
              double radius_m) const;

 private:
  std::optional<Cell> cell_;
};

/// True only when a disc of `radius_m` can move along the straight segment from `from_in_map` to
/// `to_in_map`: nowhere on it is the nearest square that is not free closer than the radius (to 1e-6 of
/// a cell), and no such square is touched, not even at a corner.
///
/// Safe, and nearly tight: it may refuse a line that passes at up to 0.115 of a cell more than the
/// radius. It never refuses a line between neighbours in a row or column that are both traversable, nor
/// between diagonal neighbours when the two beside them are traversable as well.
///
/// How: it visits every square between four centres that the segment touches (supercover), and jumps
/// ahead by the clearance where there is plenty. `blocker`, if given, is set to the cell that stopped
/// the line.
bool is_line_free(const ClearanceField& clearance, geometry::Point2 from_in_map, geometry::Point2 to_in_map,
                  double radius_m, Blocker* blocker = nullptr);

/// Distance in metres along the ray from `from_in_map` in direction `angle_rad` (radians, in map) to
/// the first cell that is not free; `max_range_m` when there is none nearer. Outside the grid there is
/// nothing.
///
/// Exact grid traversal (Amanatides, Woo 1987): from border to border, one cell at a time. @pre finite
/// numbers
double cast_ray(const OccupancyGrid& grid, geometry::Point2 from_in_map, double angle_rad, double max_range_m);

}  // namespace aisle::grid
