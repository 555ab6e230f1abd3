#pragma once
#include <string>
#include <vector>

#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// Judges a path without knowing how it was found: does it begin and end where the problem says, and is every cell that it
/// touches, corners included, one that this vehicle may be in? Empty when it is; else one line that says what is wrong and where.
std::string why_not_drivable(const Problem& problem, const std::vector<geometry::Point2>& path_in_map);

inline bool is_drivable(const Problem& problem, const std::vector<geometry::Point2>& path_in_map) {
  return why_not_drivable(problem, path_in_map).empty();
}

}  // namespace aisle::global_planner
