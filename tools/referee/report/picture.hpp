#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::referee {

/// A rectangle of the map, drawn with y upwards into a picture whose y grows downwards.
struct Frame {
  geometry::Point2 low_in_map;
  geometry::Point2 high_in_map;
  double left_px{0.0};
  double top_px{0.0};
  double px_per_m{1.0};
  double x(double x_m) const { return left_px + (x_m - low_in_map.x) * px_per_m; }
  double y(double y_m) const { return top_px + (high_in_map.y - y_m) * px_per_m; }
  double width_px() const { return (high_in_map.x - low_in_map.x) * px_per_m; }
  double height_px() const { return (high_in_map.y - low_in_map.y) * px_per_m; }
};

/// "M x y L x y ..." of a polyline; points nearer than a third of a pixel to the one before are left out.
std::string path_of(const Frame& frame, const std::vector<geometry::Point2>& points_in_map);

/// Text as it may stand between tags and in attributes.
std::string escaped(std::string_view text);

/// Colours that people with any colour vision tell apart (Okabe, Ito 2008), then repeated.
const char* vehicle_colour(std::size_t index);

inline constexpr const char* kInk = "#1f2933";
inline constexpr const char* kFaint = "#7b8794";
inline constexpr const char* kAlarm = "#d11149";
inline constexpr const char* kFont = "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\"";

}  // namespace aisle::referee
