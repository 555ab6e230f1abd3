#pragma once

#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "tools/lab/planning/offline_plan.hpp"
#include "tools/lab/results/result_text.hpp"

namespace aisle::lab {

/// The figures of one answer: outcome, length_m, length_ratio (over the grid's optimum, where it is known), nodes,
/// turning_points, turning_angle_rad, expanded, clearance_m, time_us, fault (what the checker says). Figures of a path
/// that was not found are null. time_us alone differs from run to run, and grows when other threads work too.
Row plan_figures(const OfflineAnswer& answer);

/// Its keys, in order.
std::vector<std::string> plan_columns();

/// The answer as rows of a file: one of `kind` "plan" with its figures, then one of kind "waypoint" a point of the
/// path: x_m, y_m in map, yaw_rad (the planner's, else towards the next point) and clearance_m, a lower bound.
std::vector<Row> plan_rows(const OfflineAnswer& answer, const grid::ClearanceField& clearance);

}  // namespace aisle::lab
