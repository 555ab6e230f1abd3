#pragma once

#include <vector>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/floor_bins.hpp"

namespace aisle::global_planner::traffic {

/// Where the points of a lattice may lie, and how close.
struct LatticeSpec {
  double need_m{0.45};               // least clearance of a point
  double pitch_m{1.0};               // edge of the lattice's squares
  geometry::Point2 origin_in_map{};  // a corner of one of them
};

/// Points nearer to each other than this share of the pitch are one.
inline constexpr double kLeastApart = 0.86;

/// Points to stand at, spread over the free floor: the centres of the squares of a lattice, moved to where there is
/// room.
///
///   centre of each square, or the free point of the square nearest to it
///      ─► those that moved least come first; nearer than kLeastApart pitches to one that came: dropped
///      ─► in narrow places moved towards more clearance, 5 cm at a time
///
/// @param within only squares whose centres lie in this box
/// @param taken points that stay where they are, which new ones keep away from
/// @return the new points, in an order that depends on nothing else
std::vector<geometry::Point2> lattice_points(const grid::ClearanceField& clearance, const LatticeSpec& spec,
                                             const Box& within, const std::vector<geometry::Point2>& taken);

/// The box of all that the field covers.
Box floor_box(const grid::ClearanceField& clearance);

}  // namespace aisle::global_planner::traffic
