#include "services/global-planner/core/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace aisle::global_planner {
namespace {

using geometry::Point2;

/// A point in metres, for messages.
std::string text(Point2 p) { return fmt::format("({:.2f}, {:.2f})", p.x, p.y); }

/// Start or goal is outside; names the map's extent.
RefusalReport out_of_map(const Problem& problem) {
  const grid::Geometry& g = problem.clearance.geometry();
  const bool is_start = !is_in_map(g, problem.start_in_map);

  return {is_start ? Refusal::kStartOutOfMap : Refusal::kGoalOutOfMap,
          fmt::format("the {} {} is outside the map, x {:.2f} to {:.2f}, y {:.2f} to {:.2f}",
                      is_start ? "start" : "goal", text(is_start ? problem.start_in_map : problem.goal_in_map),
                      g.origin_in_map.x, g.origin_in_map.x + g.width * g.resolution_m, g.origin_in_map.y,
                      g.origin_in_map.y + g.height * g.resolution_m)};
}

/// An obstacle there, or too little room for the vehicle.
RefusalReport blocked(const Problem& problem, bool is_start) {
  const Point2 end = is_start ? problem.start_in_map : problem.goal_in_map;
  const char* what = is_start ? "start" : "goal";

  const double here_m = std::min(problem.clearance.clearance_m(end),
                                 problem.clearance.clearance_m(problem.clearance.geometry().cell_at(end)));
  if (here_m <= 0.0) {
    return {is_start ? Refusal::kStartInObstacle : Refusal::kGoalInObstacle,
            fmt::format("the {} {} lies on an obstacle or in unknown space", what, text(end))};
  }

  return {is_start ? Refusal::kStartTooTight : Refusal::kGoalTooTight,
          here_m >= problem.radius_m
              ? fmt::format("the vehicle does not fit at the {} {} with its heading there", what, text(end))
              : fmt::format("the {} {} has {:.2f} m of clearance, the vehicle needs {:.2f} m", what, text(end), here_m,
                            problem.radius_m)};
}

/// Start and goal are free, and nothing leads from one to the other.
RefusalReport no_path(const Problem& problem, const OutOfTime& out_of_time) {
  const double widest_m = widest_way_m(problem, out_of_time);
  const std::string ends = text(problem.start_in_map) + " to " + text(problem.goal_in_map);
  if (widest_m <= 0.0) return {Refusal::kNoWay, "no way from " + ends + ", however small the vehicle"};

  if (widest_m >= problem.radius_m && problem.steering.turning_radius_m > 0.0) {
    return {Refusal::kTooStiff,
            fmt::format(
                "no way from {} with a turning radius of {:.2f} m was found, though a radius of {:.2f} m fits through",
                ends, problem.steering.turning_radius_m, problem.radius_m)};
  }

  return {Refusal::kTooWide, fmt::format("no way from {} for a radius of {:.2f} m; the widest one lets {:.2f} m pass",
                                         ends, problem.radius_m, widest_m)};
}

}  // namespace

RefusalReport explain(const Problem& problem, Outcome outcome, const OutOfTime& out_of_time) {
  if (!geometry::is_finite(problem.start_in_map)) return {Refusal::kNotFinite, "the start is not a finite point"};
  if (!geometry::is_finite(problem.goal_in_map)) return {Refusal::kNotFinite, "the goal is not a finite point"};
  if (!std::isfinite(problem.radius_m) || problem.radius_m < 0.0)
    return {Refusal::kNotFinite, "the radius is not a finite number from 0 up"};

  switch (outcome) {
    case Outcome::kOutOfMap:
      return out_of_map(problem);
    case Outcome::kStartBlocked:
      return blocked(problem, true);
    case Outcome::kGoalBlocked:
      return blocked(problem, false);
    case Outcome::kOutOfTime:
      return {Refusal::kOutOfTime,
              "the search from " + text(problem.start_in_map) + " to " + text(problem.goal_in_map) + " took too long"};
    case Outcome::kNoPath:
    case Outcome::kFound:
      break;
  }

  return no_path(problem, out_of_time);
}

// Widest path: Dijkstra's algorithm where a way is as wide as its narrowest cell, and the widest open cell comes first.
double widest_way_m(const Problem& problem, const OutOfTime& out_of_time) {
  const grid::ClearanceField& field = problem.clearance;
  const grid::Geometry& geometry = field.geometry();
  const std::size_t goal = geometry.index(geometry.cell_at(problem.goal_in_map));
  const grid::Cell start = geometry.cell_at(problem.start_in_map);

  // A diagonal step needs both orthogonal ones, so orthogonal steps alone are as wide.
  constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

  std::vector<bool> is_done(geometry.cells(), false);
  std::priority_queue<std::pair<double, std::size_t>> open;  // widest first
  open.push({field.clearance_m(start), geometry.index(start)});

  for (std::size_t looked_at = 0; !open.empty(); ++looked_at) {
    if (looked_at % 1024 == 0 && out_of_time && out_of_time()) return 0.0;

    const auto [width_m, index] = open.top();
    open.pop();
    if (index == goal || width_m <= 0.0) return width_m;

    if (is_done[index]) continue;
    is_done[index] = true;

    const grid::Cell cell{static_cast<int>(index % static_cast<std::size_t>(geometry.width)),
                          static_cast<int>(index / static_cast<std::size_t>(geometry.width))};
    for (const auto& [dx, dy] : kSides) {
      const grid::Cell next{cell.x + dx, cell.y + dy};
      if (!geometry.contains(next) || is_done[geometry.index(next)]) continue;
      open.push({std::min(width_m, field.clearance_m(next)), geometry.index(next)});
    }
  }

  return 0.0;
}

const char* name(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNotFinite:
      return "not finite";
    case Refusal::kStartOutOfMap:
      return "start out of map";
    case Refusal::kGoalOutOfMap:
      return "goal out of map";
    case Refusal::kStartInObstacle:
      return "start in obstacle";
    case Refusal::kGoalInObstacle:
      return "goal in obstacle";
    case Refusal::kStartTooTight:
      return "start too tight";
    case Refusal::kGoalTooTight:
      return "goal too tight";
    case Refusal::kTooWide:
      return "too wide";
    case Refusal::kTooStiff:
      return "cannot steer";
    case Refusal::kNoWay:
      return "no way";
    case Refusal::kOutOfTime:
      return "out of time";
  }

  return "?";
}

}  // namespace aisle::global_planner
