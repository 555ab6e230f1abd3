#include "services/local-planner/core/keep_out.hpp"

#include <algorithm>

#include "common/grid/polygon_cells.hpp"

namespace aisle::local_planner {

void KeepOut::set_map(const grid::OccupancyGrid& grid, const grid::ClearanceField& clearance) {
  grid_ = &grid;
  of_map_ = &clearance;
  is_old_ = true;
}

void KeepOut::set_zones(const std::vector<fleet::Zone>& zones) {
  zones_.clear();
  for (const fleet::Zone& zone : zones)
    if (zone.kind == fleet::Zone::Kind::kKeepOut) zones_.push_back(zone);
  is_closed_.clear();
  is_old_ = true;
}

/// A vehicle that drives along a zone is not in it, whatever rounding says; one that leaves it is out only when all
/// cells that the zone touches lie behind it.
bool KeepOut::is_closed(std::size_t zone, const geometry::Pose2& base_in_map, double reach_m) const {
  constexpr double kClearlyInM = 0.05;
  constexpr double kClearlyOutM = 0.1;
  const geometry::Point2 base = base_in_map.position();
  const double gap_m = fleet::distance_m(zones_[zone], base, base) - reach_m;
  if (is_closed_.empty()) return gap_m >= 0.0;

  return is_closed_[zone] ? gap_m >= -kClearlyInM : gap_m >= kClearlyOutM;
}

const grid::ClearanceField* KeepOut::clearance(const std::optional<geometry::Pose2>& base_in_map, double reach_m) {
  if (zones_.empty() || of_map_ == nullptr) return of_map_;

  if (base_in_map) {
    std::vector<bool> is_closed_now(zones_.size());
    for (std::size_t i = 0; i < zones_.size(); ++i) is_closed_now[i] = is_closed(i, *base_in_map, reach_m);
    is_old_ = is_old_ || is_closed_now != is_closed_;
    is_closed_ = is_closed_now;
  }
  if (!is_old_) return &field_;

  grid::OccupancyGrid floor = *grid_;
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    if (!is_closed_.empty() && !is_closed_[i]) continue;
    for (const grid::Cell cell : grid::cells_touching(floor.geometry(), fleet::corners_of(zones_[i])))
      floor.set(cell, grid::Occupancy::kOccupied);
  }

  field_ = grid::ClearanceField(floor);
  is_old_ = false;
  return &field_;
}

}  // namespace aisle::local_planner
