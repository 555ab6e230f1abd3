#include "services/local-planner/core/route.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {

using geometry::Point2;

namespace {
constexpr double kSamePointM = 0.01;  // nearer points are one
}

Route::Route(const std::vector<Point2>& points_in_map) {
  for (const Point2 p : points_in_map) {
    const double step = points_.empty() ? 0.0 : geometry::distance(points_.back(), p);
    if (!points_.empty() && step < kSamePointM) continue;

    along_m_.push_back(points_.empty() ? 0.0 : along_m_.back() + step);
    points_.push_back(p);
  }

  if (!points_in_map.empty() && points_.size() > 1) points_.back() = points_in_map.back();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i)
    heading_rad_.push_back(geometry::bearing(points_[i], points_[i + 1]));
}

std::size_t Route::point_before(double s_m) const {
  const auto after = std::upper_bound(along_m_.begin(), along_m_.end(), s_m);
  return after == along_m_.begin() ? 0 : static_cast<std::size_t>(std::distance(along_m_.begin(), after)) - 1;
}

std::size_t Route::segment_at(double s_m) const {
  return std::min(point_before(s_m), points_.size() < 2 ? 0 : points_.size() - 2);
}

Point2 Route::at(double s_m) const {
  if (points_.size() == 1) return points_.front();

  const std::size_t i = segment_at(s_m);
  const double t = std::clamp((s_m - along_m_[i]) / (along_m_[i + 1] - along_m_[i]), 0.0, 1.0);

  return points_[i] + t * (points_[i + 1] - points_[i]);
}

double Route::heading_at(double s_m) const {
  if (points_.size() == 1) return 0.0;

  return heading_rad_[segment_at(s_m)];
}

double Route::project(Point2 p, double from_s_m, double to_s_m) const {
  const double from = std::clamp(from_s_m, 0.0, length_m());
  double best_s = from;
  const Point2 off = p - at(from);
  double best_m2 = geometry::dot(off, off);

  if (points_.size() < 2) return best_s;

  // The foot on each segment that touches [from, to], t = (p - a) . (b - a) / |b - a|^2 within [0, 1].
  for (std::size_t i = segment_at(from); i + 1 < points_.size() && along_m_[i] <= to_s_m; ++i) {
    const Point2 ab = points_[i + 1] - points_[i];
    const double length_m = along_m_[i + 1] - along_m_[i];
    const double t = std::clamp(geometry::dot(p - points_[i], ab) / geometry::dot(ab, ab), 0.0, 1.0);

    const double s = std::clamp(along_m_[i] + t * length_m, from, std::max(from, to_s_m));
    const Point2 beside = p - (points_[i] + std::clamp((s - along_m_[i]) / length_m, 0.0, 1.0) * ab);
    const double m2 = geometry::dot(beside, beside);
    if (m2 < best_m2) {
      best_m2 = m2;
      best_s = s;
    }
  }

  return best_s;
}

std::vector<Point2> Route::part(double from_s_m, double to_s_m) const {
  std::vector<Point2> points{at(from_s_m)};
  for (std::size_t i = point_before(from_s_m) + 1; i < points_.size() && along_m_[i] < to_s_m; ++i)
    if (along_m_[i] > from_s_m) points.push_back(points_[i]);

  if (to_s_m > from_s_m) points.push_back(at(to_s_m));
  return points;
}

Route Route::spliced(const std::vector<Point2>& head, double s_m) const {
  std::vector<Point2> points = head;
  points.push_back(at(s_m));
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (along_m_[i] > s_m) points.push_back(points_[i]);

  return Route(points);
}

std::vector<Point2> resample(const std::vector<Point2>& points, double step_m) {
  const Route route(points);
  if (route.empty()) return {};

  const auto pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(route.length_m() / step_m)));

  std::vector<Point2> out;
  for (std::size_t i = 0; i <= pieces; ++i)
    out.push_back(route.at(route.length_m() * static_cast<double>(i) / static_cast<double>(pieces)));

  out.back() = points.back();

  return out;
}

}  // namespace aisle::local_planner
