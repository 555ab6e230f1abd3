#include "services/global-planner/core/path_figures.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::global_planner {
namespace {

using geometry::Point2;

constexpr double kLeastTurn_rad = 1e-6;  // less is a straight line, but for rounding

/// Looks four times a cell along each segment.
double least_clearance_m(const grid::ClearanceField& clearance, const std::vector<Point2>& path) {
  double least_m = clearance.max_m();

  for (std::size_t i = 1; i < path.size(); ++i) {
    const int pieces =
        1 + static_cast<int>(4.0 * geometry::distance(path[i - 1], path[i]) / clearance.geometry().resolution_m);
    for (int k = 0; k <= pieces; ++k) {
      least_m = std::min(
          least_m, clearance.clearance_m(path[i - 1] + (static_cast<double>(k) / pieces) * (path[i] - path[i - 1])));
    }
  }

  return least_m;
}

}  // namespace

// The angle from one step to the next is atan2(a x b, a . b).
PathFigures path_figures(const grid::ClearanceField& clearance, const std::vector<Point2>& path) {
  PathFigures figures;
  figures.nodes = static_cast<int>(path.size());

  Point2 before{0.0, 0.0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2 step = path[i] - path[i - 1];
    if (geometry::norm(step) <= 0.0) continue;

    figures.length_m += geometry::norm(step);

    if (geometry::norm(before) > 0.0) {
      const double turn_rad = std::abs(std::atan2(geometry::cross(before, step), geometry::dot(before, step)));
      if (turn_rad > kLeastTurn_rad) ++figures.turning_points;
      figures.turning_angle_rad += turn_rad;
    }

    before = step;
  }

  figures.least_clearance_m = least_clearance_m(clearance, path);
  return figures;
}

}  // namespace aisle::global_planner
