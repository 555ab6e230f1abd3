#include "tools/lab/driving/window_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace aisle::cli {
namespace {

using geometry::Point2;

constexpr double kPxPerM = 42.0;
constexpr double kTopPx = 34.0;
constexpr double kBottomPx = 40.0;
constexpr double kLookS = 0.1;             // between two points of a way
constexpr std::size_t kOutlineEvery = 20;  // points: two seconds
constexpr double kOutlineApartM = 0.5;     // nearer to the one before, none is drawn
constexpr const char* kVehicle = "#0072b2";
constexpr const char* kMover = "#d55e00";
constexpr const char* kSubTarget = "#1b7837";
constexpr const char* kInk = "#323f4b";

struct Sheet {
  grid::Geometry geometry;
  double width_px() const { return geometry.width * geometry.resolution_m * kPxPerM; }
  double height_px() const { return geometry.height * geometry.resolution_m * kPxPerM; }
  double x(Point2 p) const { return (p.x - geometry.origin_in_map.x) * kPxPerM; }
  double y(Point2 p) const { return kTopPx + height_px() - (p.y - geometry.origin_in_map.y) * kPxPerM; }
};

/// Rows of occupied cells, equal rows below each other as one.
std::string walls(const grid::OccupancyGrid& grid, const Sheet& sheet) {
  const grid::Geometry& g = grid.geometry();
  const double cell_px = g.resolution_m * kPxPerM;
  std::string path;
  const auto is_same_below = [&](int x0, int x1, int y) {
    for (int x = x0; x < x1; ++x)
      if (y < 0 || grid.is_free({x, y}) != grid.is_free({x, y + 1})) return false;
    return true;
  };
  std::vector<bool> done(static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height), false);
  for (int y = g.height - 1; y >= 0; --y)
    for (int x = 0; x < g.width; ++x) {
      if (done[g.index({x, y})] || grid.is_free({x, y})) continue;
      int end = x, low = y;
      while (end < g.width && !done[g.index({end, y})] && !grid.is_free({end, y})) ++end;
      while (is_same_below(x, end, low - 1)) --low;
      for (int dy = low; dy <= y; ++dy)
        for (int dx = x; dx < end; ++dx) done[g.index({dx, dy})] = true;
      const Point2 center = g.center_in_map({x, y});
      path += fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", sheet.x(center) - 0.5 * cell_px,
                          sheet.y(center) - 0.5 * cell_px, (end - x) * cell_px, (y - low + 1) * cell_px,
                          -(end - x) * cell_px);
    }
  return fmt::format("<path d=\"{}\" fill=\"#4a5462\"/>\n", path);
}

/// Where its times stand beside it.
struct Beside {
  double dx_px, dy_px;
  const char* anchor;
};

std::string way(const Sheet& sheet, const std::vector<Point2>& points, double radius_m, const char* colour,
                const Beside& beside) {
  std::string line, outlines;
  Point2 last{1e9, 1e9};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point2 p = points[i];
    line += fmt::format("{:.1f},{:.1f} ", sheet.x(p), sheet.y(p));
    if (i % kOutlineEvery != 0 || geometry::distance(p, last) < kOutlineApartM) continue;
    last = p;
    outlines += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" fill=\"{3}\" fill-opacity=\"0.12\" stroke=\"{3}\" "
        "stroke-width=\"0.8\"/>"
        "<text x=\"{4:.1f}\" y=\"{5:.1f}\" font-size=\"11\" text-anchor=\"{6}\" fill=\"{3}\">{7:.0f} s</text>\n",
        sheet.x(p), sheet.y(p), radius_m * kPxPerM, colour, sheet.x(p) + beside.dx_px, sheet.y(p) + beside.dy_px,
        beside.anchor, kLookS * static_cast<double>(i));
  }
  return outlines +
         fmt::format(
             "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"/>\n",
             line, colour);
}

std::string aims(const Sheet& sheet, const WindowScene& scene) {
  std::string text;
  for (const WindowScene::Aimed& aimed : scene.sub_targets)
    text += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}L{2:.1f} {3:.1f}\" stroke=\"{4}\" stroke-width=\"0.5\" opacity=\"0.6\"/><circle "
        "cx=\"{2:.1f}\" cy=\"{3:.1f}\" r=\"2.5\" fill=\"{4}\"/>\n",
        sheet.x(aimed.from_in_map), sheet.y(aimed.from_in_map), sheet.x(aimed.at_in_map), sheet.y(aimed.at_in_map),
        kSubTarget);
  return text;
}

std::string nearest(const Sheet& sheet, const WindowScene& scene) {
  const std::size_t moments = std::min(scene.driven_in_map.size(), scene.mover_in_map.size());
  if (moments == 0) return "";
  std::size_t best = 0;
  const auto apart_m = [&](std::size_t i) { return geometry::distance(scene.driven_in_map[i], scene.mover_in_map[i]); };
  for (std::size_t i = 1; i < moments; ++i)
    if (apart_m(i) < apart_m(best)) best = i;
  const Point2 a = scene.driven_in_map[best], b = scene.mover_in_map[best];
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#b2182b\" stroke-width=\"1.5\" stroke-dasharray=\"3 2\"/>"
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12\" text-anchor=\"end\" fill=\"#b2182b\">nearest: {:.2f} m between "
      "the outlines, at {:.1f} s</text>\n",
      sheet.x(a), sheet.y(a), sheet.x(b), sheet.y(b), sheet.width_px() - 12.0, kTopPx + 22.0,
      apart_m(best) - scene.vehicle_radius_m - scene.mover_radius_m, kLookS * static_cast<double>(best));
}

std::string end_mark(const Sheet& sheet, Point2 at, const char* name) {
  return fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}l5 5m0 -10l-10 10m0 -10l5 5\" stroke=\"{2}\" stroke-width=\"1.5\"/><text "
      "x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\" fill=\"{2}\">{4}</text>\n",
      sheet.x(at), sheet.y(at), kInk, sheet.y(at) + 34.0, name);
}

std::string legend(const Sheet& sheet, const WindowScene& scene) {
  const double y = kTopPx + sheet.height_px() + 24.0;
  double x = 10.0;
  std::string text;
  const auto entry = [&](const std::string& symbol, const char* name) {
    text +=
        fmt::format("<g transform=\"translate({:.0f} {:.0f})\">{}<text x=\"34\" y=\"4\" fill=\"{}\">{}</text></g>\n", x,
                    y, symbol, kInk, name);
    x += 190.0;
  };
  const auto stroke = [](const char* colour, const char* dashes) {
    return fmt::format("<path d=\"M0 0h26\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\"/>", colour,
                       dashes);
  };
  entry(stroke("#7b8794", "6 4"), "path");
  entry(stroke(kVehicle, "none"), "vehicle, every 2 s");
  if (!scene.mover_in_map.empty()) entry(stroke(kMover, "none"), "mover, every 2 s");
  if (!scene.sub_targets.empty()) entry(stroke(kSubTarget, "none"), "local sub-target");
  if (!scene.boxes.empty())
    entry("<rect x=\"5\" y=\"-8\" width=\"16\" height=\"16\" fill=\"#8d6e63\"/>", "box, not in the map");
  text += fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}v6h{2:.1f}v-6\" fill=\"none\" stroke=\"{3}\"/><text x=\"{4:.1f}\" y=\"{5:.1f}\" "
      "text-anchor=\"end\" fill=\"{3}\">2 m</text>\n",
      sheet.width_px() - 10.0 - 2.0 * kPxPerM, y - 6.0, 2.0 * kPxPerM, kInk, sheet.width_px() - 18.0 - 2.0 * kPxPerM,
      y + 4.0);
  return text;
}

}  // namespace

std::string window_svg(const grid::OccupancyGrid& grid, const WindowScene& scene) {
  const Sheet sheet{grid.geometry()};
  std::string body =
      fmt::format("<text x=\"10\" y=\"22\" font-size=\"15\" font-weight=\"bold\" fill=\"{}\">{}</text>\n", kInk,
                  scene.title) +
      walls(grid, sheet);
  body += fmt::format(
      "<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#7b8794\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"/>\n",
      sheet.x(scene.start_in_map), sheet.y(scene.start_in_map), sheet.x(scene.goal_in_map), sheet.y(scene.goal_in_map));
  for (const WindowScene::Box& box : scene.boxes)
    body +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#8d6e63\"/>\n",
                    sheet.x(box.low_in_map), sheet.y(box.high_in_map), (box.high_in_map.x - box.low_in_map.x) * kPxPerM,
                    (box.high_in_map.y - box.low_in_map.y) * kPxPerM);
  body += aims(sheet, scene);
  const bool is_across =
      scene.mover_in_map.empty() || std::abs(scene.mover_in_map.back().y - scene.mover_in_map.front().y) >
                                        std::abs(scene.mover_in_map.back().x - scene.mover_in_map.front().x);
  const double outline_px = scene.mover_radius_m * kPxPerM;
  body += way(sheet, scene.mover_in_map, scene.mover_radius_m, kMover,
              is_across ? Beside{outline_px + 4.0, 4.0, "start"} : Beside{0.0, -outline_px - 4.0, "middle"});
  body += way(
      sheet, scene.driven_in_map, scene.vehicle_radius_m, kVehicle,
      {0.0, is_across ? -scene.vehicle_radius_m * kPxPerM - 4.0 : scene.vehicle_radius_m * kPxPerM + 13.0, "middle"});
  body += nearest(sheet, scene) + end_mark(sheet, scene.start_in_map, "start") +
          end_mark(sheet, scene.goal_in_map, "goal") + legend(sheet, scene);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#f5f7fa\"/>\n{2}</svg>\n",
      sheet.width_px(), kTopPx + sheet.height_px() + kBottomPx, body);
}

}  // namespace aisle::cli
