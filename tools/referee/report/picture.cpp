#include "tools/referee/report/picture.hpp"

#include <fmt/format.h>

#include <cmath>

namespace aisle::referee {

std::string path_of(const Frame& frame, const std::vector<geometry::Point2>& points_in_map) {
  std::string out;
  double last_x = 0.0;
  double last_y = 0.0;
  for (std::size_t i = 0; i < points_in_map.size(); ++i) {
    const double x = frame.x(points_in_map[i].x);
    const double y = frame.y(points_in_map[i].y);
    const bool is_end = i == 0 || i + 1 == points_in_map.size();
    if (!is_end && std::hypot(x - last_x, y - last_y) < 0.33) continue;
    out += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x, y);
    last_x = x;
    last_y = y;
  }
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

const char* vehicle_colour(std::size_t index) {
  static constexpr std::array<const char*, 8> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                       "#e69f00", "#56b4e9", "#6a3d9a", "#8c6d31"};
  return kColours[index % kColours.size()];
}

}  // namespace aisle::referee
