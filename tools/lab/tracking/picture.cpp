#include "tools/lab/tracking/picture.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/draw/colours.hpp"
#include "tools/draw/map_frame.hpp"
#include "tools/draw/walls.hpp"

namespace aisle::tracking {
namespace {

using geometry::Point2;

constexpr double kEdgePx = 800.0;
constexpr double kVehicleRadiusM = 0.35;
constexpr std::size_t kTrackColours = 8;

/// A way in one colour.
std::string line(const std::vector<Point2>& way, const draw::MapFrame& frame, const char* colour, double width_px) {
  return draw::polyline(frame, way,
                        fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", colour,
                                    width_px)) +
         "\n";
}

/// Adds a point unless it is nearly the one before.
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

  for (const fleet::Track& track : now.tracks[contestant_]) go_on(tracks_[track.id], track.position_in_map);
}

/// True ways are broad and grey, tracks thin and coloured over them.
std::string Picture::svg() const {
  const draw::MapFrame frame = draw::fitted_frame(walls_.geometry(), kEdgePx);

  std::string body = draw::path(draw::boxes_path(frame, draw::grid_layers(walls_).occupied, draw::Digits::kFine),
                                fmt::format("fill=\"{}\"", draw::kWall)) +
                     "\n";
  for (const auto& [id, way] : people_) body += line(way, frame, "#c4cad3", 5.0);
  for (const auto& [id, way] : tracks_) body += line(way, frame, draw::colour(id, kTrackColours), 1.5);

  for (const auto& [id, way] : vehicles_)
    body +=
        line(way, frame, "#111111", 1.0) + draw::disc(frame, way.front(), kVehicleRadiusM, "fill=\"#111111\"") + "\n";

  draw::Page page{static_cast<int>(std::lround(frame.width_px())), static_cast<int>(std::lround(frame.height_px()))};
  page.background = "#ffffff";
  page.fills_container = true;

  return draw::document(page, body);
}

}  // namespace aisle::tracking
