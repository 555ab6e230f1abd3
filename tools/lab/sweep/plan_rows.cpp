#include "tools/lab/sweep/plan_rows.hpp"

#include <algorithm>

#include "services/global-planner/core/refusal.hpp"

namespace aisle::lab {
namespace {

using global_planner::Outcome;

const char* word_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFound:
      return "found";
    case Outcome::kNoPath:
      return "no_path";
    case Outcome::kStartBlocked:
      return "start_blocked";
    case Outcome::kGoalBlocked:
      return "goal_blocked";
    case Outcome::kOutOfMap:
      return "out_of_map";
    case Outcome::kOutOfTime:
      return "out_of_time";
  }
  return "?";
}

/// Towards the next point; at the last one as before.
double heading_rad(const global_planner::PlannedPath& plan, std::size_t i) {
  if (i < plan.headings_rad.size()) return plan.headings_rad[i];
  const auto& points = plan.waypoints_in_map;
  const std::size_t from = std::min(i, points.size() - 2);
  return points.size() < 2 ? 0.0 : geometry::bearing(points[from], points[from + 1]);
}

}  // namespace

Row plan_figures(const OfflineAnswer& answer) {
  const Answer& it = answer.answer;
  Row row{{"outcome", word_of(it.plan.outcome)}};
  const bool is_found = it.plan.outcome == Outcome::kFound;
  const auto figure = [&](const char* key, const Row& value) { row[key] = is_found ? value : Row(nullptr); };

  figure("length_m", finite(it.figures.length_m));
  figure("length_ratio", answer.optimum_m > 0.0 ? finite(it.figures.length_m / answer.optimum_m) : Row(nullptr));
  figure("nodes", it.figures.nodes);
  figure("turning_points", it.figures.turning_points);
  figure("turning_angle_rad", finite(it.figures.turning_angle_rad));
  row["expanded"] = it.plan.expanded;
  figure("clearance_m", finite(it.figures.least_clearance_m));
  row["time_us"] = finite(it.time_us);
  row["fault"] = it.fault;

  return row;
}

std::vector<std::string> plan_columns() { return columns_of({plan_figures({"", 0, Answer{}, 0.0})}); }

std::vector<Row> plan_rows(const OfflineAnswer& answer, const grid::ClearanceField& clearance) {
  const global_planner::PlannedPath& plan = answer.answer.plan;
  std::vector<Row> rows{Row{{"kind", "plan"}, {"planner", answer.planner}, {"query", answer.query}}};
  rows.front().update(plan_figures(answer));

  for (std::size_t i = 0; i < plan.waypoints_in_map.size(); ++i) {
    const geometry::Point2 point = plan.waypoints_in_map[i];
    rows.push_back({{"kind", "waypoint"},
                    {"planner", answer.planner},
                    {"query", answer.query},
                    {"index", i},
                    {"x_m", point.x},
                    {"y_m", point.y},
                    {"yaw_rad", finite(heading_rad(plan, i))},
                    {"clearance_m", finite(clearance.clearance_m(point))}});
  }

  return rows;
}

}  // namespace aisle::lab
