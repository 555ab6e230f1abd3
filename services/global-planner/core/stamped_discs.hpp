#pragma once
#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::global_planner {

struct Disc {
  geometry::Point2 center_in_map;
  double radius_m{0.0};
};

/// Puts discs into a grid and its clearance field for as long as it lives, then takes them out again; both are then cell by cell
/// what they were. Only windows around the discs are recomputed.
class StampedDiscs {
 public:
  StampedDiscs(grid::OccupancyGrid& grid, grid::ClearanceField& clearance, const std::vector<Disc>& discs);
  ~StampedDiscs();
  StampedDiscs(const StampedDiscs&) = delete;
  StampedDiscs& operator=(const StampedDiscs&) = delete;

 private:
  struct Window {
    grid::Cell low;
    grid::Cell high;
  };
  grid::OccupancyGrid& grid_;
  grid::ClearanceField& clearance_;
  std::vector<grid::Cell> stamped_;
  std::vector<Window> windows_;
};

}  // namespace aisle::global_planner
