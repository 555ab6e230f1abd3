#include "tools/lab/driving/ways_svg.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/map_frame.hpp"
#include "tools/draw/walls.hpp"

namespace aisle::lab {
namespace {

constexpr double kEdgePx = 640.0;
constexpr int kTopPx = 36;  // for the title
constexpr int kKeyPx = 20;  // from one name of the legend to the next
constexpr double kEndM = 0.2;
constexpr const char* kMover = "#b88217";
constexpr const char* kBox = "#8a94a0";

std::string movers_layer(const draw::MapFrame& frame, const std::vector<scenario::Mover>& movers) {
  std::string svg;
  for (const scenario::Mover& mover : movers) {
    svg +=
        draw::polyline(frame, mover.waypoints_in_map,
                       fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"6 4\"", kMover));
    for (const geometry::Point2 end : mover.waypoints_in_map)
      svg += draw::disc(frame, end, mover.radius_m,
                        fmt::format("fill=\"{0}\" fill-opacity=\"0.35\" stroke=\"{0}\"", kMover));
    svg += "\n";
  }
  return svg;
}

std::string boxes_layer(const draw::MapFrame& frame, const std::vector<scenario::Block>& boxes) {
  std::string svg;
  for (const scenario::Block& box : boxes)
    svg += draw::turned_rect(frame, box.center_in_map, box.length_m, box.width_m,
                             fmt::format("fill=\"{}\" stroke=\"{}\"", kBox, draw::kSoftInk)) +
           "\n";
  return svg;
}

std::string end_mark(const draw::MapFrame& frame, geometry::Point2 in_map, const char* letter) {
  return draw::disc(frame, in_map, kEndM, fmt::format("fill=\"none\" stroke=\"{}\"", draw::kInk)) +
         draw::text(frame.x(in_map.x) + 9.0, frame.y(in_map.y) - 7.0, fmt::format("fill=\"{}\"", draw::kInk), letter) +
         "\n";
}

}  // namespace

std::string ways_svg(const std::string& title, const DrawnMap& map, const Encounters& encounters,
                     const std::vector<DrivenWay>& ways) {
  draw::MapFrame frame = draw::fitted_frame(map.grid.geometry(), kEdgePx);
  frame.top_px = kTopPx;

  std::string body = draw::text(10, 22, "font-size=\"15\" font-weight=\"bold\"", title) + "\n" +
                     draw::path(draw::boxes_path(frame, draw::obstacles(map.grid), draw::Digits::kFine),
                                fmt::format("fill=\"{}\"", draw::kWall)) +
                     "\n" + boxes_layer(frame, encounters.boxes) + movers_layer(frame, encounters.movers) +
                     end_mark(frame, map.start_in_map, "S") + end_mark(frame, map.goal_in_map, "T");

  int y_px = kTopPx + static_cast<int>(std::lround(frame.height_px())) + kKeyPx;
  for (std::size_t i = 0; i < ways.size(); ++i, y_px += kKeyPx) {
    body += draw::polyline(frame, ways[i].in_map,
                           fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\" "
                                       "opacity=\"0.85\"",
                                       draw::colour(i))) +
            "\n" + draw::curve_key(10, y_px, draw::colour(i), ways[i].name);
  }
  return draw::document(
      {static_cast<int>(std::lround(frame.width_px())), y_px, std::string(draw::kSansSerif) + " font-size=\"13\""},
      body);
}

}  // namespace aisle::lab
