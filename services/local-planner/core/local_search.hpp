#pragma once
#include <functional>
#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::local_planner {

/// Something that stands, in map.
struct Disc {
  geometry::Point2 position;
  double radius_m{0.0};
};

/// Where a vehicle may be: walls by the clearance field, what stands by discs.
struct Room {
  const grid::ClearanceField& clearance;
  const std::vector<Disc>& discs;
  double radius_m{0.35};  // of the vehicle
  double wall_margin_m{0.10};
  double disc_margin_m{0.15};

  /// Distance to spare at `p`; negative: not allowed. Capped at 1 m.
  double spare_m(geometry::Point2 p) const;
  /// May the vehicle go straight from `a` to `b`? Looked at every 5 cm.
  bool is_line_free(geometry::Point2 a, geometry::Point2 b) const;
};

/// Shortest way on a lattice of 0.2 m (8 neighbours, dearer near obstacles and left of the line to `towards`) from
/// `from` to the cheapest point that `accepts`, within `reach_m`; then straightened. Where `from` itself has too little
/// room, ways out of there are allowed that do not lead deeper in. Empty: there is none. Dijkstra 1959.
std::vector<geometry::Point2> search_way(const Room& room, geometry::Point2 from, geometry::Point2 towards,
                                         double reach_m, const std::function<bool(geometry::Point2)>& accepts);

}  // namespace aisle::local_planner
