#pragma once

#include <optional>

#include "services/global-planner/core/connected_parts.hpp"
#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// The centre, in map, of the cell nearest to the goal that the vehicle can reach from the start, cutting no corner: it
/// tells how far off an unreachable goal is. Empty when the start itself is blocked or out of the map, or when out of
/// time (asked once, before the work).
std::optional<geometry::Point2> nearest_reachable(const Problem& problem, const OutOfTime& out_of_time);

/// The same with `parts`, which are made if need be and good for further problems on the same field.
std::optional<geometry::Point2> nearest_reachable(const Problem& problem, ConnectedParts& parts,
                                                  const OutOfTime& out_of_time);

/// A plan to the goal. Where there is none because of the goal or the way, one to the nearest reachable point, which is
/// then the path's last; where that fails as well, the first refusal.
[[nodiscard]] PlannedPath plan_to_nearest(Planner& planner, const Problem& problem, const OutOfTime& out_of_time);

}  // namespace aisle::global_planner
