#pragma once

#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/neighbours.hpp"

namespace aisle::global_planner {

/// The steps of kSteps that a vehicle may take from this cell, as a mask: into the grid, cutting no corner.
inline unsigned open_steps(const Drivable& drivable, grid::Cell cell) {
  unsigned mask = 0;

  for (unsigned i = 0; i < kSteps.size(); ++i) {
    mask |= static_cast<unsigned>(drivable.is_traversable(grid::Cell{cell.x + kSteps[i].dx, cell.y + kSteps[i].dy}))
            << i;
  }

  return kDrivableDiagonals[mask];
}

}  // namespace aisle::global_planner
