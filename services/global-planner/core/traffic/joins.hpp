#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/floor_bins.hpp"
#include "services/global-planner/core/traffic/lattice.hpp"

namespace aisle::global_planner::traffic {

/// Two points between which a vehicle may drive, by their numbers, the lesser first.
using Join = std::pair<std::size_t, std::size_t>;

/// Joins neighbours, the nearest first, where a disc of `need_m` can pass, no third point is passed closely, and no way
/// round over other joins is nearly as short.
///
/// @param existing joins that stay, and count as ways round
/// @param near only pairs whose box touches this one are tried
/// @return the new joins
std::vector<Join> join_neighbours(const grid::ClearanceField& clearance, const LatticeSpec& spec,
                                  const std::vector<geometry::Point2>& points, const std::vector<Join>& existing,
                                  const Box& near);

/// A join along a way that is not straight.
struct Bridge {
  Join join;
  std::vector<geometry::Point2> way_in_map;  // from the first point to the second
};

/// What the floor between points shows that neighbours alone do not.
struct Bridging {
  std::vector<Bridge> bridges;            // between points that touch on the floor and have no way, or a long one
  std::vector<geometry::Point2> islands;  // spots that no point reaches: one in each piece of floor
};

/// Joins what is connected on the floor, but not yet by joins.
///
/// Floods the floor from all points. Where the floods of two points meet that are in different parts, or have only a
/// way round of more than twice the length, there is a bridge, the shortest first.
///
/// @param part of each point: equal numbers are joined already, also by ways outside the window
/// @param joins between these points so far
/// @param touching only islands that reach into this box are told
Bridging bridge_parts(const grid::ClearanceField& clearance, double need_m, const std::vector<geometry::Point2>& points,
                      const std::vector<std::size_t>& part, const std::vector<Join>& joins, const Box& window,
                      const Box& touching);

/// Which things are joined, directly or by others (union-find).
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count);
  std::size_t of(std::size_t i);

  /// @return false: they were one part already
  bool join(std::size_t a, std::size_t b);

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace aisle::global_planner::traffic
