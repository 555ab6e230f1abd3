#pragma once

#include <optional>
#include <vector>

#include "common/fleet/zone.hpp"
#include "common/grid/clearance.hpp"

namespace aisle::local_planner {

/// The map's clearance as one vehicle has to keep it: the floor of keep-out zones counts as occupied, but for zones
/// that the vehicle stands in, so that it may leave them. A zone that it has left is closed to it.
class KeepOut {
 public:
  /// Both must stay, unchanged, until the next call.
  void set_map(const grid::OccupancyGrid& grid, const grid::ClearanceField& clearance);

  void set_zones(const std::vector<fleet::Zone>& zones);

  /// Of a vehicle there, whose outline lies within `reach_m` of its base. Without keep-out zones the map's own; null:
  /// there is no map yet. Valid until the next call of any function.
  const grid::ClearanceField* clearance(const std::optional<geometry::Pose2>& base_in_map, double reach_m);

 private:
  bool is_closed(std::size_t zone, const geometry::Pose2& base_in_map, double reach_m) const;

  const grid::OccupancyGrid* grid_{nullptr};
  const grid::ClearanceField* of_map_{nullptr};
  std::vector<fleet::Zone> zones_;  // that keep out
  std::vector<bool> is_closed_;     // each of them, to the vehicle; empty: it is not known yet where that is
  grid::ClearanceField field_;
  bool is_old_{true};
};

}  // namespace aisle::local_planner
