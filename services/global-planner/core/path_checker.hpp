#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// Judges a path without knowing how it was found. Does it begin and end where the problem says, and does a disc of the
/// problem's radius sweep it without coming nearer to any square that is not free, or touching one at a corner? Exact,
/// except where a tight start or goal shrinks the radius: there it looks ten times a cell.
/// @return empty when all is well; else one line that says what is wrong and where
std::string why_not_drivable(const Problem& problem, const std::vector<geometry::Point2>& path_in_map);

inline bool is_drivable(const Problem& problem, const std::vector<geometry::Point2>& path_in_map) {
  return why_not_drivable(problem, path_in_map).empty();
}

/// The vehicle that drives along a plan.
struct Outline {
  geometry::Footprint footprint{};
  std::optional<double> start_yaw_rad;  // none: it faces along its way from the start on
  std::optional<double> goal_yaw_rad;   // none: it stays as it arrives
};

/// Where the vehicle is and faces along the plan: at the plan's headings, if it has any; else along its way, turning on
/// the spot at each point, the shorter way round.
std::vector<geometry::Pose2> poses_along(const PlannedPath& plan, const Outline& outline);

/// The same for an outline. A rectangle is swept along poses_along(): it may touch squares that are not free, but not
/// overlap them, and the problem's radius does not count. For a disc only the problem's radius counts.
std::string why_not_drivable(const Problem& problem, const PlannedPath& plan, const Outline& outline);

}  // namespace aisle::global_planner
