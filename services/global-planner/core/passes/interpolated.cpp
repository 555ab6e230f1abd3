#include <algorithm>
#include <cmath>

#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {
namespace {

using geometry::Point2;
constexpr int kMostSamples = 64;  // a segment

/// One a cell.
int samples_between(const Drivable& drivable, Point2 from, Point2 to) {
  const double cells = geometry::distance(from, to) / drivable.geometry().resolution_m;
  return std::clamp(static_cast<int>(std::ceil(cells)), 1, kMostSamples);
}

/// The farthest sample from `from` towards `to` that `eye` can be joined to; `from` itself is known to be. As if all
/// were tried, from the farthest on; those that lie in the shadow of one cell are left out together, found by
/// bisection.
Point2 farthest_seen(const Drivable& drivable, Point2 eye, Point2 from, Point2 to) {
  const int samples = samples_between(drivable, from, to);
  const auto sample = [&](int i) {
    return i == samples ? to : from + (static_cast<double>(i) / samples) * (to - from);
  };
  grid::Blocker blocker;
  for (int i = samples; i > 0;) {
    if (drivable.is_line_free(eye, sample(i), blocker)) return sample(i);
    int nearest_stopped = i;
    if (drivable.is_stopped_by(blocker, eye, sample(i))) {
      for (int passing = 0; nearest_stopped - passing > 1;) {
        const int middle = passing + (nearest_stopped - passing) / 2;
        (drivable.is_stopped_by(blocker, eye, sample(middle)) ? nearest_stopped : passing) = middle;
      }
    }
    i = nearest_stopped - 1;
  }
  return from;
}

/// The last sample from `from` towards `to` before the first that `eye` cannot be joined to at the safe distance.
Point2 farthest_safe(const Drivable& drivable, Point2 eye, Point2 from, Point2 to) {
  const int samples = samples_between(drivable, from, to);
  Point2 safe = from;
  for (int i = 1; i <= samples; ++i) {
    const Point2 sample = i == samples ? to : from + (static_cast<double>(i) / samples) * (to - from);
    if (!drivable.is_line_safe(eye, sample)) break;
    safe = sample;
  }
  return safe;
}

/// Moves each point but the ends to where `farthest` says, seen from the point kept before; one that comes to the next
/// is dropped.
template <class Farthest>
void move_along(const Drivable& drivable, std::vector<Point2>& path, const Farthest& farthest) {
  if (path.size() < 3) return;
  std::size_t kept = 1;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point2 moved = farthest(drivable, path[kept - 1], path[i], path[i + 1]);
    if (moved != path[i + 1]) path[kept++] = moved;
  }
  path[kept++] = path.back();
  path.resize(kept);
}

}  // namespace

void interpolated_forward(const Drivable& drivable, std::vector<Point2>& path) {
  move_along(drivable, path, farthest_seen);
}

void interpolated_at_safe_distance(const Drivable& drivable, std::vector<Point2>& path) {
  move_along(drivable, path, farthest_safe);
}

void interpolated_backward(const Drivable& drivable, std::vector<Point2>& path) {
  std::reverse(path.begin(), path.end());
  interpolated_forward(drivable, path);
  std::reverse(path.begin(), path.end());
}

}  // namespace aisle::global_planner::passes
