#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "tools/draw/svg.hpp"

namespace aisle::draw {

/// A rectangle of the map in a picture: metres with y upwards become pixels with y downwards.
struct MapFrame {
  geometry::Point2 low_in_map;
  geometry::Point2 high_in_map;
  double left_px{0.0};
  double top_px{0.0};
  double px_per_m{1.0};

  /// Metres in map to pixels in the picture.
  double x(double x_m) const { return left_px + (x_m - low_in_map.x) * px_per_m; }
  double y(double y_m) const { return top_px + (high_in_map.y - y_m) * px_per_m; }
  PointPx at(geometry::Point2 in_map) const { return {x(in_map.x), y(in_map.y)}; }

  /// Size of the rectangle in the picture.
  double width_px() const { return (high_in_map.x - low_in_map.x) * px_per_m; }
  double height_px() const { return (high_in_map.y - low_in_map.y) * px_per_m; }
};

/// The whole grid, its upper left corner at (0, top).
MapFrame frame_of(const grid::Geometry& geometry, double px_per_m, double top_px = 0.0);

/// The whole grid, its longer edge `edge_px` long, its upper left corner at (0, 0).
MapFrame fitted_frame(const grid::Geometry& geometry, double edge_px);

/// The `d` of a path along the points; points nearer than a third of a pixel to the one before are left out, the last
/// is not.
std::string path_along(const MapFrame& frame, const std::vector<geometry::Point2>& points_in_map);

/// The straight line from `a` to `b`, both in map.
std::string line(const MapFrame& frame, geometry::Point2 a, geometry::Point2 b, std::string_view attributes);

/// A line through all the points.
std::string polyline(const MapFrame& frame, const std::vector<geometry::Point2>& points_in_map,
                     std::string_view attributes);

/// A circle; the radius is in metres of the map.
std::string disc(const MapFrame& frame, geometry::Point2 center_in_map, double radius_m, std::string_view attributes);

/// A rectangle with its middle and heading at `middle_in_map`; `length_m` along the heading.
std::string turned_rect(const MapFrame& frame, const geometry::Pose2& middle_in_map, double length_m, double width_m,
                        std::string_view attributes);

/// A bracket that is `length_m` long, from (left_px, y_px) to the right.
std::string scale_bar(const MapFrame& frame, double left_px, double y_px, double length_m, std::string_view attributes);

}  // namespace aisle::draw
