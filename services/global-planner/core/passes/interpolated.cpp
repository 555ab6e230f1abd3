#include <algorithm>
#include <cmath>

#include "services/global-planner/core/passes/passes.hpp"

namespace aisle::global_planner::passes {
namespace {

using geometry::Point2;
constexpr int kMostSamples = 64;   // a segment

/// The farthest sample from `from` towards `to` that `eye` can be joined to; `from` itself is known to be.
Point2 farthest_seen(const Drivable& drivable, Point2 eye, Point2 from, Point2 to) {
  const double cells = geometry::distance(from, to) / drivable.geometry().resolution_m;
  const int samples = std::clamp(static_cast<int>(std::ceil(cells)), 1, kMostSamples);
  for (int i = samples; i > 0; --i) {
    const Point2 sample = i == samples ? to : from + (static_cast<double>(i) / samples) * (to - from);
    if (drivable.is_line_free(eye, sample)) return sample;
  }
  return from;
}

}  // namespace

void interpolated_forward(const Drivable& drivable, std::vector<Point2>& path) {
  if (path.size() < 3) return;
  std::size_t kept = 1;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point2 seen = farthest_seen(drivable, path[kept - 1], path[i], path[i + 1]);
    if (seen != path[i + 1]) path[kept++] = seen;
  }
  path[kept++] = path.back();
  path.resize(kept);
}

void interpolated_backward(const Drivable& drivable, std::vector<Point2>& path) {
  std::reverse(path.begin(), path.end());
  interpolated_forward(drivable, path);
  std::reverse(path.begin(), path.end());
}

}  // namespace aisle::global_planner::passes
