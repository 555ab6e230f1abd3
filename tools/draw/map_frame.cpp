#include "tools/draw/map_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace aisle::draw {
namespace {

using geometry::Point2;

constexpr double kLeastApartPx = 0.33;  // of two corners of a path

}  // namespace

MapFrame frame_of(const grid::Geometry& geometry, double px_per_m, double top_px) {
  const Point2 low = geometry.origin_in_map;
  const Point2 size_m{geometry.width * geometry.resolution_m, geometry.height * geometry.resolution_m};
  return {low, low + size_m, 0.0, top_px, px_per_m};
}

MapFrame fitted_frame(const grid::Geometry& geometry, double edge_px) {
  return frame_of(geometry, edge_px / (std::max(geometry.width, geometry.height) * geometry.resolution_m));
}

/// Corners that no eye can tell apart only make the file larger.
std::string path_along(const MapFrame& frame, const std::vector<Point2>& points_in_map) {
  std::vector<PointPx> kept;
  for (std::size_t i = 0; i < points_in_map.size(); ++i) {
    const PointPx p = frame.at(points_in_map[i]);
    const bool is_last = i + 1 == points_in_map.size();
    if (!kept.empty() && !is_last && std::hypot(p.x - kept.back().x, p.y - kept.back().y) < kLeastApartPx) continue;
    kept.push_back(p);
  }

  return path_along(kept);
}

std::string line(const MapFrame& frame, Point2 a, Point2 b, std::string_view attributes) {
  return path(path_along({frame.at(a), frame.at(b)}), attributes);
}

std::string polyline(const MapFrame& frame, const std::vector<Point2>& points_in_map, std::string_view attributes) {
  std::vector<PointPx> points;
  points.reserve(points_in_map.size());
  for (const Point2 p : points_in_map) points.push_back(frame.at(p));
  return polyline(points, attributes);
}

std::string disc(const MapFrame& frame, Point2 center_in_map, double radius_m, std::string_view attributes) {
  return circle(frame.x(center_in_map.x), frame.y(center_in_map.y), radius_m * frame.px_per_m, attributes);
}

std::string turned_rect(const MapFrame& frame, const geometry::Pose2& middle_in_map, double length_m, double width_m,
                        std::string_view attributes) {
  const double l = 0.5 * length_m, w = 0.5 * width_m;
  const std::vector<Point2> corners{geometry::to_map(middle_in_map, {l, w}), geometry::to_map(middle_in_map, {-l, w}),
                                    geometry::to_map(middle_in_map, {-l, -w}),
                                    geometry::to_map(middle_in_map, {l, -w})};

  return path(path_along(frame, corners) + "z", attributes);
}

std::string scale_bar(const MapFrame& frame, double left_px, double y_px, double length_m,
                      std::string_view attributes) {
  return path(fmt::format("M{:.1f} {:.1f}v6h{:.1f}v-6", left_px, y_px, length_m * frame.px_per_m), attributes);
}

}  // namespace aisle::draw
