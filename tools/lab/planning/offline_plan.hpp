#pragma once

#include <functional>
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
  bool goes_to_nearest{false};  // where the goal cannot be reached

  /// How far clearances must be known for it.
  double needed_clearance_m() const;
};

/// The answers of all planners.
struct OfflineResult {
  std::vector<Tally> tallies;    // one a planner
  std::vector<DrawnPath> paths;  // of the first query
  std::string refusal;           // of the first query that was refused: "goal blocked: ..."; empty: none was
};

/// Asks each planner each query. Ends early, with what was asked until then, once `is_interrupted`.
OfflineResult plan_offline(const OfflineTask& task, const std::vector<const global_planner::Variant*>& planners,
                           const grid::ClearanceField& clearance, const std::function<bool()>& is_interrupted);

}  // namespace aisle::lab
