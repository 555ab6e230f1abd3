#pragma once

#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::local_planner {

/// Something that stands, in map.
struct Disc {
  geometry::Point2 position;
  double radius_m{0.0};
};

/// Where a vehicle's centre may be: walls by the clearance field, what stands by discs.
struct Room {
  const grid::ClearanceField& clearance;
  const std::vector<Disc>& discs;
  double radius_m{0.35};  // of the vehicle
  double wall_margin_m{0.10};
  double disc_margin_m{0.15};

  /// Distance in metres to spare at `p`; negative: not allowed there. Capped at 1 m.
  double spare_m(geometry::Point2 p) const;

  /// May the vehicle go straight from `a` to `b`? Looked at every 5 cm.
  bool is_line_free(geometry::Point2 a, geometry::Point2 b) const;
};

}  // namespace aisle::local_planner
