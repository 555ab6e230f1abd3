#pragma once
#include <optional>

#include "common/grid/clearance.hpp"

namespace aisle::grid {

/// A cell that is not free and stopped a line, if one is known that surely did. Lines from one point that it stops end
/// in a convex shadow: where it stops the lines to two ends, it stops those to all points between.
class Blocker {
 public:
  Blocker() = default;
  explicit Blocker(std::optional<Cell> cell) : cell_(cell) {}

  /// True only when a disc of this radius surely touches the cell on the segment. Good as long as the field does not
  /// change.
  bool blocks(const Geometry& geometry, geometry::Point2 from_in_map, geometry::Point2 to_in_map,
              double radius_m) const;

 private:
  std::optional<Cell> cell_;
};

/// True only when a disc of `radius_m` may sweep the straight segment from `from` to `to`: nowhere on it is the nearest
/// square that is not free closer than the radius (to 1e-6 of a cell), and no such square is touched, not even at a
/// corner. Safe, and nearly tight: it may say no to a line that passes within 0.115 of a cell too close. It never says
/// no between neighbours in a row or column that are both traversable, nor between diagonal neighbours when the two
/// beside them are as well. Visits every square between four centres that the segment touches (supercover), and steps
/// by the clearance where there is plenty. `blocker`, if given, is what stopped the line.
bool is_line_free(const ClearanceField& clearance, geometry::Point2 from_in_map, geometry::Point2 to_in_map,
                  double radius_m, Blocker* blocker = nullptr);

/// First point of the ray from `from` in direction `angle_rad` that lies on a cell that is not free, as a distance in
/// metres; `max_range_m` when there is none. Exact grid traversal (Amanatides, Woo 1987). Outside the grid is empty
/// space.
/// @pre finite numbers
double cast_ray(const OccupancyGrid& grid, geometry::Point2 from_in_map, double angle_rad, double max_range_m);

}  // namespace aisle::grid
