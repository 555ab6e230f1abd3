#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "common/grid/clearance.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::python {

/// A map as Python holds it: its cells never change, so the distances to its walls are computed once.
class Map {
 public:
  Map(grid::OccupancyGrid grid, std::optional<geometry::Point2> start_in_map,
      std::optional<geometry::Point2> goal_in_map)
      : grid_(std::move(grid)), start_in_map_(start_in_map), goal_in_map_(goal_in_map) {}

  const grid::OccupancyGrid& grid() const { return grid_; }

  /// Of plans and drives that name no other; S and T of a drawn map.
  const std::optional<geometry::Point2>& start_in_map() const { return start_in_map_; }
  const std::optional<geometry::Point2>& goal_in_map() const { return goal_in_map_; }

  /// Distances to what is not free, known up to `cap_m`. May be called from several threads.
  std::shared_ptr<const grid::ClearanceField> clearance(double cap_m) const;

 private:
  grid::OccupancyGrid grid_;
  std::optional<geometry::Point2> start_in_map_, goal_in_map_;
  mutable std::mutex mutex_;
  mutable double cap_m_{0.0};
  mutable std::shared_ptr<const grid::ClearanceField> clearance_;  // for cap_m_
};

}  // namespace aisle::python
