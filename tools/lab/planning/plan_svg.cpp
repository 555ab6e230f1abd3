#include "tools/lab/planning/plan_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/map_frame.hpp"
#include "tools/draw/walls.hpp"

namespace aisle::lab {
namespace {

constexpr int kMostBlocks = 400;  // along the longer edge of the map
constexpr double kEdgePx = 800.0;
constexpr int kLegendPx = 150;
constexpr int kRowPx = 20;             // of the legend
constexpr std::size_t kMostDots = 60;  // corners of a path with more have no dots

std::string map_layers(const grid::OccupancyGrid& grid, const draw::MapFrame& frame) {
  const int longest = std::max(grid.geometry().width, grid.geometry().height);
  const draw::GridLayers layers = draw::grid_layers(grid, std::max(1, (longest + kMostBlocks - 1) / kMostBlocks));
  const auto filled = [&](const std::vector<draw::Box>& boxes, const char* colour) {
    return draw::path(draw::boxes_path(frame, boxes, draw::Digits::kFine), fmt::format("fill=\"{}\"", colour)) + "\n";
  };

  return filled(layers.unknown, draw::kUnknown) + filled(layers.occupied, draw::kWall);
}

std::string path_layer(const std::vector<geometry::Point2>& path, const draw::MapFrame& frame, const char* colour) {
  std::string svg = draw::polyline(
      frame, path,
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\" opacity=\"0.85\"", colour));
  for (const geometry::Point2 p : path) {
    if (path.size() <= kMostDots)
      svg += draw::circle(frame.x(p.x), frame.y(p.y), 3, fmt::format("fill=\"{}\"", colour));
  }

  return svg + "\n";
}

}  // namespace

/// Unknown and occupied cells as boxes, then the paths, then the legend below.
std::string plan_svg(const grid::OccupancyGrid& grid, const std::vector<DrawnPath>& paths) {
  const draw::MapFrame frame = draw::fitted_frame(grid.geometry(), kEdgePx);
  const int width_px = static_cast<int>(std::lround(frame.width_px()));
  std::string body = map_layers(grid, frame), legend;
  int y_px = kRowPx;

  for (std::size_t i = 0; i < paths.size(); ++i, y_px += kRowPx) {
    body += path_layer(paths[i].in_map, frame, draw::colour(i));
    legend += draw::curve_key(width_px + 10, y_px, draw::colour(i), paths[i].name);
  }

  const int height_px = std::max(static_cast<int>(std::lround(frame.height_px())), y_px + 10);
  return draw::document({width_px + kLegendPx, height_px, std::string(draw::kSansSerif) + " font-size=\"13\""},
                        body + legend);
}

}  // namespace aisle::lab
