#include "tools/lab/tracking/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace aisle::tracking {
namespace {

using geometry::Point2;

constexpr double kEdge_px = 800.0;
constexpr std::array<const char*, 8> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#6a3d9a", "#b2182b"};

struct Sheet {
  grid::Geometry geometry;
  double px_per_m;
  double x(Point2 p) const { return (p.x - geometry.origin_in_map.x) * px_per_m; }
  double y(Point2 p) const { return height_px() - (p.y - geometry.origin_in_map.y) * px_per_m; }
  double width_px() const { return geometry.width * geometry.resolution_m * px_per_m; }
  double height_px() const { return geometry.height * geometry.resolution_m * px_per_m; }
};

Sheet sheet_of(const grid::OccupancyGrid& walls) {
  const grid::Geometry& g = walls.geometry();
  return {g, kEdge_px / (std::max(g.width, g.height) * g.resolution_m)};
}

std::string walls_layer(const grid::OccupancyGrid& walls, const Sheet& sheet) {
  const grid::Geometry& g = walls.geometry();
  const double cell_px = g.resolution_m * sheet.px_per_m;
  std::string path;
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      if (walls.at({x, y}) != grid::Occupancy::kOccupied) continue;
      const int first = x;
      while (x + 1 < g.width && walls.at({x + 1, y}) == grid::Occupancy::kOccupied) ++x;
      const double run_px = (x + 1 - first) * cell_px;
      path += fmt::format("M{:.5g} {:.5g}h{:.5g}v{:.5g}h{:.5g}z", first * cell_px, (g.height - y - 1) * cell_px, run_px,
                          cell_px, -run_px);
    }
  }
  return fmt::format("<path d=\"{}\" fill=\"#4a5462\"/>\n", path);
}

std::string line(const std::vector<Point2>& way, const Sheet& sheet, const char* colour, double width_px) {
  std::string points;
  for (const Point2 p : way) points += fmt::format("{:.1f},{:.1f} ", sheet.x(p), sheet.y(p));
  return fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>\n", points,
      colour, width_px);
}

/// Points nearer than this to the one before are left out.
void go_on(std::vector<Point2>& way, Point2 to) {
  constexpr double kStep_m = 0.1;
  if (way.empty() || geometry::distance(way.back(), to) >= kStep_m) way.push_back(to);
}

}  // namespace

Picture::Picture(const grid::OccupancyGrid& walls, std::size_t contestant, double begin_s, double end_s)
    : walls_(walls), contestant_(contestant), begin_s_(begin_s), end_s_(end_s) {}

void Picture::look(const Glance& now) {
  if (now.t_s < begin_s_ || now.t_s > end_s_) return;
  for (const Walking& person : now.truth.people)
    go_on(people_[static_cast<std::uint64_t>(person.id)], person.position_in_map);
  for (std::size_t v = 0; v < now.truth.vehicles.size(); ++v)
    go_on(vehicles_[v], now.truth.vehicles[v].base_in_map.position());
  for (const obstacle_tracker::Track& track : now.tracks[contestant_]) go_on(tracks_[track.id], track.position_in_map);
}

std::string Picture::svg() const {
  const Sheet sheet = sheet_of(walls_);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#ffffff\"/>\n",
      sheet.width_px(), sheet.height_px());
  svg += walls_layer(walls_, sheet);
  for (const auto& [id, way] : people_) svg += line(way, sheet, "#c4cad3", 5.0);
  for (const auto& [id, way] : tracks_) svg += line(way, sheet, kColours[id % kColours.size()], 1.5);
  for (const auto& [id, way] : vehicles_) {
    svg += line(way, sheet, "#111111", 1.0);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"#111111\"/>\n", sheet.x(way.front()),
                       sheet.y(way.front()), 0.35 * sheet.px_per_m);
  }
  return svg + "</svg>\n";
}

}  // namespace aisle::tracking
