#pragma once

#include <vector>

#include "common/grid/clearance.hpp"
#include "common/grid/polygon_cells.hpp"

namespace aisle::global_planner {

/// A round obstacle that is not in the map.
struct Disc {
  geometry::Point2 center_in_map;
  double radius_m{0.0};
};

/// Puts discs and polygons into the clearance field of a grid for as long as it lives, then takes them out again; the
/// field is then, cell by cell, what it was. Only windows around them are computed anew.
class StampedDiscs {
 public:
  /// Every free cell whose square touches a disc or a polygon counts as occupied. Both `grid` and `clearance` must
  /// outlive this object; the field must be that of the grid.
  StampedDiscs(const grid::OccupancyGrid& grid, grid::ClearanceField& clearance, const std::vector<Disc>& discs,
               const std::vector<std::vector<geometry::Point2>>& polygons = {});
  ~StampedDiscs();
  StampedDiscs(const StampedDiscs&) = delete;
  StampedDiscs& operator=(const StampedDiscs&) = delete;

 private:
  /// The cells around a disc that the field was computed anew for; both corners included.
  struct Window {
    grid::Cell low;
    grid::Cell high;
  };

  const grid::OccupancyGrid& grid_;
  grid::ClearanceField& clearance_;
  std::vector<Window> windows_;
};

}  // namespace aisle::global_planner
