#pragma once

#include <cstdint>
#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

/// Distance from each cell's centre to the nearest *square* cell that is not free, in metres, capped at `max_m`;
/// outside the grid counts as occupied. Exact at the centres (Euclidean distance transform after Felzenszwalb,
/// Huttenlocher 2012, with the edges of the squares as sites), stored as float: right to 1e-6 of the value.
class ClearanceField {
 public:
  ClearanceField() = default;

  /// @param max_m at most 16000 cells are looked at, whatever is asked for
  explicit ClearanceField(const OccupancyGrid& grid, double max_m = 5.0);

  /// After an edit of the cells from `low` to `high` (both included): recomputes only what can have changed.
  /// Afterwards equal, cell by cell, to a field made anew from `grid`. Nothing to do when `high` lies below `low`.
  /// `also_occupied`: cells that count as occupied whatever `grid` says; those that come or go lie within `low` to
  /// `high`.
  /// @pre same geometry as before
  void update(const OccupancyGrid& grid, Cell low, Cell high, const std::vector<Cell>& also_occupied = {});

  /// Size and place: those of the grid that the field was made from.
  const Geometry& geometry() const { return geometry_; }

  /// What is farther away than this counts as this far, in metres.
  double max_m() const { return max_m_; }

  /// A number of this content: another one after each change, and never that of a field with other
  /// content. So a caller can tell whether something that it made from a field is still good. 0 for an
  /// empty field.
  std::uint64_t revision() const { return revision_; }

  /// Exact at the cell's centre (capped): the radius of the largest disc that may stand there. 0 on obstacles and
  /// outside the grid.
  double clearance_m(Cell c) const { return geometry_.contains(c) ? clearance_m_[geometry_.index(c)] : 0.0; }

  /// Clearances of all cells in metres, row by row from the bottom (index as Geometry::index), for
  /// loops that stay in the grid.
  const std::vector<float>& cells_m() const { return clearance_m_; }

  /// A safe lower bound of the distance from any point to the nearest occupied square: interpolated between the four
  /// centres around it, less what bilinear interpolation can overestimate there (at most 0.115 of a cell; nothing at
  /// the centres), and never less than the smallest of the four. 0 on obstacles and outside the grid.
  double clearance_m(geometry::Point2 in_map) const;

  /// May a disc of this radius (margin included) stand with its middle on the centre of `c`? Never on a
  /// cell that is not free.
  bool is_traversable(Cell c, double radius_m) const {
    const double clearance = clearance_m(c);
    return clearance > 0.0 && clearance >= radius_m;
  }

 private:
  /// The usual case of clearance_m(Point2); 0: not that case. See there.
  double clearance_between_free_m(double u, double v) const;

  /// Computes the cells from `low` to `high`, both included, anew.
  void recompute(const OccupancyGrid& grid, const std::vector<Cell>& also_occupied, Cell low, Cell high);

  Geometry geometry_;
  double max_m_{0.0};
  std::uint64_t revision_{0};
  std::vector<float> clearance_m_;
};

}  // namespace aisle::grid
