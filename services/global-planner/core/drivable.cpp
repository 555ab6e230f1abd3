#include "services/global-planner/core/drivable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aisle::global_planner {
namespace {

using geometry::Point2;

/// Even a vehicle without size may not be on an obstacle.
constexpr double kLeastRadius_m = 1e-6;

/// The least float that is not below the number.
float rounded_up(double number) {
  const auto rounded = static_cast<float>(number);
  return static_cast<double>(rounded) >= number ? rounded : std::nextafter(rounded, std::numeric_limits<float>::max());
}

}  // namespace

Drivable::Drivable(const Problem& problem)
    : clearance_(problem.clearance),
      geometry_(problem.clearance.geometry()),
      clearances_m_(problem.clearance.cells_m().data()),
      radius_m_(std::max(problem.radius_m, kLeastRadius_m)),
      safe_distance_m_(problem.safe_distance_m),
      least_m_(rounded_up(radius_m_)),
      start_(tight_end(problem, problem.start_in_map)),
      goal_(tight_end(problem, problem.goal_in_map)),
      has_tight_end_(start_.range_m > 0.0 || goal_.range_m > 0.0) {}

TightEnd Drivable::tight_end(const Problem& problem, Point2 end_in_map) const {
  const double here_m =
      std::min(clearance_.clearance_m(end_in_map), clearance_.clearance_m(geometry_.cell_at(end_in_map)));

  const bool is_tight = here_m < radius_m_ && here_m >= std::max(problem.least_radius_m, kLeastRadius_m);
  return {end_in_map, is_tight ? problem.tight_range_m : 0.0, here_m};
}

bool Drivable::is_traversable_at_tight_end(float clearance_m, grid::Cell c) const {
  // A step may lead out of the range, so cells count as within it only where the whole step is.
  const double cell_m = geometry_.resolution_m;
  double radius_m = radius_m_;

  for (const TightEnd* end : {&start_, &goal_}) {
    const double range_m = end->range_m > 0.0 ? std::max(end->range_m - 1.5 * cell_m, 0.75 * cell_m) : -1.0;

    if (geometry::distance(geometry_.center_in_map(c), end->center_in_map) <= range_m)
      radius_m = std::min(radius_m, end->radius_m);
  }

  return clearance_m >= radius_m;
}

double Drivable::radius_at(Point2 in_map) const {
  double radius_m = radius_m_;
  for (const TightEnd* end : {&start_, &goal_}) {
    if (end->range_m > 0.0 && geometry::distance(in_map, end->center_in_map) <= end->range_m)
      radius_m = std::min(radius_m, end->radius_m);
  }

  return radius_m;
}

bool Drivable::is_line_free(Point2 from, Point2 to) const {
  grid::Blocker blocker;
  return is_line_free(from, to, blocker);
}

bool Drivable::is_line_free(Point2 from, Point2 to, grid::Blocker& blocker) const {
  if (grid::is_line_free(clearance_, from, to, radius_m_, &blocker)) return true;
  if (!has_tight_end_) return false;

  // A tight end may let the vehicle pass what stopped it: look at points, four in a cell.
  blocker = {};
  const double length_m = geometry::distance(from, to);
  const int pieces = 1 + static_cast<int>(length_m / (0.25 * geometry_.resolution_m));
  for (int i = 0; i <= pieces; ++i) {
    if (!is_free(from + (static_cast<double>(i) / pieces) * (to - from))) return false;
  }

  return true;
}

bool Drivable::is_line_safe(Point2 from, Point2 to) const {
  if (safe_distance_m_ <= radius_m_) return is_line_free(from, to);
  return grid::is_line_free(clearance_, from, to, safe_distance_m_);
}

}  // namespace aisle::global_planner
