#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/plan_svg.hpp"
#include "tools/lab/planning/queries.hpp"
#include "tools/lab/planning/tally.hpp"

namespace aisle::lab {

/// The questions of `aisle plan` to its planners, without a site. Lengths in metres, angles in radians.
struct OfflineTask {
  std::vector<Query> queries;
  geometry::Footprint outline{geometry::disc(0.0)};
  double radius_m{0.0};  // of a disc with its margin; a rectangle has its own
  double safe_distance_m{0.0};
  double preferred_clearance_m{0.0};
  double turning_radius_m{0.0};           // 0: turns on the spot
  std::optional<double> start_yaw_rad{};  // of a single query; none: any
  std::optional<double> goal_yaw_rad{};
  bool goes_to_nearest{false};                                     // where the goal cannot be reached
  std::map<std::string, global_planner::Parameters> parameters{};  // by planner; the others are as published

  /// How far clearances must be known for it.
  double needed_clearance_m() const;
};

/// The answers of all planners.
struct OfflineResult {
  std::vector<Tally> tallies;    // one a planner
  std::vector<DrawnPath> paths;  // of the first query
  std::string refusal;           // of the first query that was refused: "goal blocked: ..."; empty: none was
};

/// What one planner answered to one query. Valid while it is looked at.
struct OfflineAnswer {
  const std::string& planner;
  std::size_t query;  // its place in the task
  const Answer& answer;
  double optimum_m;  // of the grid for this vehicle, or what the query says; 0: not known
};

/// Asks each planner each query, and tells `hears_answer` of each. Ends early, with what was asked until then, once
/// `is_interrupted`.
/// @throws std::invalid_argument for a parameter that a planner has not, or a value out of its range
OfflineResult plan_offline(const OfflineTask& task, const std::vector<const global_planner::Variant*>& planners,
                           const grid::ClearanceField& clearance, const std::function<bool()>& is_interrupted,
                           const std::function<void(const OfflineAnswer&)>& hears_answer = {});

}  // namespace aisle::lab
