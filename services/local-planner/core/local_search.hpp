#pragma once

#include <functional>
#include <vector>

#include "services/local-planner/core/room.hpp"

namespace aisle::local_planner {

/// Shortest way on a lattice of 0.2 m (8 neighbours, dearer near obstacles and left of the line to `towards`) from
/// `from` to the cheapest point that `accepts`, within `reach_m`; then straightened. Where `from` itself has too little
/// room, ways out of there are allowed that do not lead deeper in. Empty: there is none.
///
/// How: Dijkstra 1959 from the start; the first node taken off the queue that is accepted ends it. The way is then
/// straightened: from each kept point on to the farthest one, within 4 m, that can be reached straight.
std::vector<geometry::Point2> search_way(const Room& room, geometry::Point2 from, geometry::Point2 towards,
                                         double reach_m, const std::function<bool(geometry::Point2)>& accepts);

}  // namespace aisle::local_planner
