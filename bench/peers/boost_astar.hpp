#pragma once

#include <memory>

#include "bench/peers/peer.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::bench {

/// `boost::astar_search` on an implicit graph: vertices are the cells' indices, edges are made up as it walks over
/// them. Its property maps are arrays that are kept between queries (which is in its favour); it fills them at the
/// begin of each search.
class BoostAstar {
 public:
  /// @pre `grid` outlives it
  explicit BoostAstar(const grid::OccupancyGrid& grid);
  ~BoostAstar();

  /// From cell to cell; not found where there is no way.
  PeerAnswer plan(grid::Cell start, grid::Cell goal);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace aisle::bench
