#include "tools/lab/planning/plan_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace aisle::cli {
namespace {

constexpr int kMostBlocks = 400;  // along the longer edge of the map
constexpr double kEdge_px = 800.0;
constexpr double kLegend_px = 150.0;
constexpr std::array<const char*, 10> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                               "#56b4e9", "#6a3d9a", "#8c6d31", "#b2182b", "#1b7837"};

struct Sheet {
  grid::Geometry geometry;
  double px_per_cell;
  double x(geometry::Point2 p) const { return (p.x - geometry.origin_in_map.x) / geometry.resolution_m * px_per_cell; }
  double y(geometry::Point2 p) const {
    return (geometry.height - (p.y - geometry.origin_in_map.y) / geometry.resolution_m) * px_per_cell;
  }
};

grid::Occupancy block_at(const grid::OccupancyGrid& grid, int x0, int y0, int edge) {
  bool is_unknown = false;
  for (int y = y0; y < std::min(y0 + edge, grid.geometry().height); ++y) {
    for (int x = x0; x < std::min(x0 + edge, grid.geometry().width); ++x) {
      if (grid.at({x, y}) == grid::Occupancy::kOccupied) return grid::Occupancy::kOccupied;
      is_unknown = is_unknown || grid.at({x, y}) == grid::Occupancy::kUnknown;
    }
  }
  return is_unknown ? grid::Occupancy::kUnknown : grid::Occupancy::kFree;
}

/// Runs of equal blocks, row by row, as one path for what is occupied and one for what is unknown.
std::string map_layer(const grid::OccupancyGrid& grid, const Sheet& sheet) {
  const grid::Geometry& g = grid.geometry();
  const int edge = std::max(1, (std::max(g.width, g.height) + kMostBlocks - 1) / kMostBlocks);
  std::string occupied, unknown;
  for (int y = 0; y < g.height; y += edge) {
    for (int x = 0; x < g.width;) {
      const grid::Occupancy here = block_at(grid, x, y, edge);
      int end = x + edge;
      while (end < g.width && block_at(grid, end, y, edge) == here) end += edge;
      if (here != grid::Occupancy::kFree) {
        const double top = (g.height - std::min(y + edge, g.height)) * sheet.px_per_cell;
        std::string& layer = here == grid::Occupancy::kOccupied ? occupied : unknown;
        layer += fmt::format("M{:.5g} {:.5g}h{:.5g}v{:.5g}h{:.5g}z", x * sheet.px_per_cell, top,
                             (std::min(end, g.width) - x) * sheet.px_per_cell, edge * sheet.px_per_cell,
                             -(std::min(end, g.width) - x) * sheet.px_per_cell);
      }
      x = end;
    }
  }
  return fmt::format("<path d=\"{}\" fill=\"#d5dae1\"/>\n<path d=\"{}\" fill=\"#4a5462\"/>\n", unknown, occupied);
}

std::string path_layer(const std::vector<geometry::Point2>& path, const Sheet& sheet, const char* colour) {
  std::string points, dots;
  for (const geometry::Point2 p : path) {
    points += fmt::format("{:.1f},{:.1f} ", sheet.x(p), sheet.y(p));
    if (path.size() <= 60)
      dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>", sheet.x(p), sheet.y(p), colour);
  }
  return fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\" "
      "opacity=\"0.85\"/>{}\n",
      points, colour, dots);
}

}  // namespace

std::string plan_svg(const grid::OccupancyGrid& grid, const std::vector<DrawnPath>& paths) {
  const grid::Geometry& g = grid.geometry();
  const Sheet sheet{g, kEdge_px / std::max(g.width, g.height)};
  const double width = g.width * sheet.px_per_cell;
  const double height = g.height * sheet.px_per_cell;
  std::string body = map_layer(grid, sheet);
  std::string legend;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    body += path_layer(paths[i].in_map, sheet, colour);
    const double y = 20.0 + 20.0 * static_cast<double>(i);
    legend += fmt::format(
        "<path d=\"M{0:.0f} {1:.0f}h24\" stroke=\"{2}\" stroke-width=\"3\"/><text x=\"{3:.0f}\" "
        "y=\"{4:.0f}\">{5}</text>\n",
        width + 10, y, colour, width + 40, y + 4, paths[i].name);
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#f5f7fa\"/>\n{2}{3}</svg>\n",
      width + kLegend_px, std::max(height, 30.0 + 20.0 * static_cast<double>(paths.size())), body, legend);
}

}  // namespace aisle::cli
