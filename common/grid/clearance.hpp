#pragma once
#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

/// Distance from each cell's centre to the centre of the nearest cell that is not free, in metres, exact (Euclidean distance
/// transform: Felzenszwalb, Huttenlocher 2012) and capped at `max_m`. Outside the grid counts as occupied.
class ClearanceField {
 public:
  ClearanceField() = default;
  explicit ClearanceField(const OccupancyGrid& grid, double max_m = 5.0);

  /// After an edit of the cells from `low` to `high` (both included): recomputes only what can have changed.
  /// Afterwards equal, cell by cell, to a field made anew from `grid`. @pre same geometry as before
  void update(const OccupancyGrid& grid, Cell low, Cell high);

  const Geometry& geometry() const { return geometry_; }
  double max_m() const { return max_m_; }

  /// Centre-to-centre distance; 0 outside the grid.
  double distance_m(Cell c) const { return geometry_.contains(c) ? distance_m_[geometry_.index(c)] : 0.0; }

  /// A safe lower bound of the distance from the point to the nearest occupied *square* cell: the interpolated
  /// centre-to-centre distance less half a cell's edge; 0 on obstacles and outside the grid.
  double clearance_m(geometry::Point2 in_map) const;

  /// The same at the cell's centre.
  double clearance_m(Cell c) const;

  /// May a vehicle of this radius (margin included) stand on the cell's centre?
  bool is_traversable(Cell c, double radius_m) const { return clearance_m(c) >= radius_m; }

 private:
  Geometry geometry_;
  double max_m_{0.0};
  std::vector<float> distance_m_;
};

}  // namespace aisle::grid
