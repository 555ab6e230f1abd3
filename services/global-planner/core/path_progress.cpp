#include "services/global-planner/core/path_progress.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace aisle::global_planner {
namespace {

constexpr double kLookAhead_m = 3.0;

/// The foot of the perpendicular, p = a + t (b - a) with t = (p - a) . (b - a) / |b - a|^2, or the nearer end.
geometry::Point2 nearest_on_segment(geometry::Point2 p, geometry::Point2 a, geometry::Point2 b) {
  const geometry::Point2 ab = b - a;
  const double length2 = geometry::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(geometry::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;

  return a + t * ab;
}

}  // namespace

PathProgress::PathProgress(std::vector<geometry::Point2> path) : path_(std::move(path)) {
  if (!path_.empty()) reached_ = path_.front();
}

void PathProgress::advance(geometry::Point2 base_in_map) {
  double best_m = std::numeric_limits<double>::infinity();
  geometry::Point2 best = reached_;
  std::size_t best_segment = segment_;

  // From the point reached on: `from` is that point first, then the path's own points.
  double ahead_m = 0.0;
  geometry::Point2 from = reached_;

  for (std::size_t i = segment_; i + 1 < path_.size() && ahead_m < kLookAhead_m; ++i) {
    const geometry::Point2 to = path_[i + 1];
    const geometry::Point2 nearest = nearest_on_segment(base_in_map, from, to);
    const double distance_m = geometry::distance(base_in_map, nearest);

    if (distance_m < best_m) {
      best_m = distance_m;
      best = nearest;
      best_segment = i;
    }

    ahead_m += geometry::distance(from, to);
    from = to;
  }

  reached_ = best;
  segment_ = best_segment;
  off_path_m_ = geometry::distance(base_in_map, reached_);
}

std::vector<geometry::Point2> PathProgress::remaining() const {
  if (path_.empty()) return {};

  std::vector<geometry::Point2> rest{reached_};
  rest.insert(rest.end(), path_.begin() + static_cast<std::ptrdiff_t>(std::min(segment_ + 1, path_.size() - 1)),
              path_.end());

  return rest;
}

}  // namespace aisle::global_planner
