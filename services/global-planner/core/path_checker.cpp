#include "services/global-planner/core/path_checker.hpp"

#include <algorithm>
#include <cstdio>

#include "services/global-planner/core/swept_outline.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// "touches an obstacle at (1.000, 2.000)"
std::string at(const char* what, Point2 p) {
  char text[160];
  std::snprintf(text, sizeof text, "%s at (%.3f, %.3f)", what, p.x, p.y);
  return text;
}

/// The radius that a point of the path must keep: smaller near a start or goal that is itself too near to an obstacle.
double radius_at(const Problem& problem, Point2 in_map) {
  double radius_m = problem.radius_m;
  for (const Point2 end : {problem.start_in_map, problem.goal_in_map}) {
    const grid::Cell cell = problem.clearance.geometry().cell_at(end);
    const double end_m = std::min(problem.clearance.clearance_m(end), problem.clearance.clearance_m(cell));

    if (end_m >= problem.least_radius_m && geometry::distance(in_map, end) <= problem.tight_range_m)
      radius_m = std::min(radius_m, end_m);
  }

  return radius_m;
}

/// What interpolation between cell centres may understate, see ClearanceField::clearance_m.
constexpr double kInterpolation_cells = 0.12;

/// Does a tight start or goal shrink the radius somewhere on the segment?
bool has_exception(const Problem& problem, Point2 a, Point2 b) {
  for (const Point2 end : {problem.start_in_map, problem.goal_in_map}) {
    if (problem.least_radius_m < problem.radius_m && geometry::distance_to_segment(end, a, b) <= problem.tight_range_m)
      return true;
  }

  return false;
}

/// Looks ten times a cell, allowing for what interpolation understates.
std::string why_not_sampled(const Problem& problem, Point2 from, Point2 to) {
  const double cell_m = problem.clearance.geometry().resolution_m;
  const int pieces = 1 + static_cast<int>(10.0 * geometry::distance(from, to) / cell_m);
  for (int k = 0; k <= pieces; ++k) {
    const Point2 p = from + (static_cast<double>(k) / pieces) * (to - from);
    const double clearance_m = problem.clearance.clearance_m(p);
    if (clearance_m <= 0.0) return at("touches an obstacle", p);
    if (clearance_m < radius_at(problem, p) - kInterpolation_cells * cell_m)
      return at("comes too near to an obstacle", p);
  }

  return {};
}

/// Looks at squares: does the line touch one, or does the disc come too near?
std::string why_not_swept(const Problem& problem, Point2 from, Point2 to) {
  const grid::Geometry& geometry = problem.clearance.geometry();
  if (const auto touched = square_near_line(problem.clearance, from, to, 0.0))
    return at("touches an obstacle", geometry.center_in_map(*touched));

  const auto near = square_near_line(problem.clearance, from, to, problem.radius_m);

  return near ? at("comes too near to an obstacle", geometry.center_in_map(*near)) : std::string{};
}

/// Ends that are not the problem's, and points outside of the map.
std::string why_wrong_ends(const Problem& problem, const std::vector<Point2>& path) {
  if (path.size() < 2) return "fewer than two points";
  if (path.front() != problem.start_in_map) return at("does not begin at the start, but", path.front());
  if (path.back() != problem.goal_in_map) return at("does not end at the goal, but", path.back());

  for (const Point2 p : path) {
    if (!is_in_map(problem.clearance.geometry(), p)) return at("leaves the map", p);
  }

  return {};
}

}  // namespace

std::string why_not_drivable(const Problem& problem, const std::vector<Point2>& path) {
  std::string wrong = why_wrong_ends(problem, path);
  for (std::size_t i = 1; i < path.size() && wrong.empty(); ++i) {
    const bool is_exact = !has_exception(problem, path[i - 1], path[i]);
    wrong = is_exact ? why_not_swept(problem, path[i - 1], path[i]) : why_not_sampled(problem, path[i - 1], path[i]);
  }

  return wrong;
}

std::vector<Pose2> poses_along(const PlannedPath& plan, const Outline& outline) {
  const std::vector<Point2>& path = plan.waypoints_in_map;

  std::vector<Pose2> poses;

  // The plan's own headings.
  if (!path.empty() && plan.headings_rad.size() == path.size()) {
    for (std::size_t i = 0; i < path.size(); ++i) poses.push_back({path[i].x, path[i].y, plan.headings_rad[i]});
    return poses;
  }

  // Along each segment, from its start to its end.
  const auto add = [&](Point2 p, double yaw_rad) { poses.push_back({p.x, p.y, yaw_rad}); };
  if (!path.empty() && outline.start_yaw_rad) add(path.front(), *outline.start_yaw_rad);

  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i] == path[i - 1]) continue;
    const double yaw_rad = geometry::bearing(path[i - 1], path[i]);

    add(path[i - 1], yaw_rad);
    add(path[i], yaw_rad);
  }

  if (!path.empty() && outline.goal_yaw_rad) add(path.back(), *outline.goal_yaw_rad);
  return poses;
}

std::string why_not_drivable(const Problem& problem, const PlannedPath& plan, const Outline& outline) {
  if (outline.footprint.is_disc()) return why_not_drivable(problem, plan.waypoints_in_map);

  std::string wrong = why_wrong_ends(problem, plan.waypoints_in_map);
  if (!wrong.empty()) return wrong;

  const std::vector<Pose2> poses = poses_along(plan, outline);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!geometry::is_finite(poses[i])) return "has a heading that is not finite";

    const auto touch = touched_on_way(problem.clearance, outline.footprint, poses[i == 0 ? 0 : i - 1], poses[i]);
    if (touch) return at("lets the outline overlap an obstacle when the vehicle is", touch->base_in_map.position());
  }

  return {};
}

}  // namespace aisle::global_planner
