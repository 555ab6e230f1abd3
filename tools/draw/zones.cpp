#include "tools/draw/zones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/svg.hpp"
#include "tools/draw/walls.hpp"

namespace aisle::draw {
namespace {

using fleet::Zone;
using geometry::Point2;

constexpr double kEdgePx = 1200.0;
constexpr int kLegendPx = 30;
constexpr int kEntryPx = 124;
constexpr double kTipPx = 7.0;

/// The colours of Okabe and Ito (2008), and the alarm for floor that is closed.
const char* colour_of(Zone::Kind kind) {
  switch (kind) {
    case Zone::Kind::kKeepOut:
      return kAlarm;
    case Zone::Kind::kSpeed:
      return "#e69f00";
    case Zone::Kind::kOneWay:
      return "#0072b2";
    case Zone::Kind::kNoStopping:
      return "#cc79a7";
    case Zone::Kind::kOneVehicle:
      return "#5d4a9c";
    case Zone::Kind::kParking:
      return "#009e73";
  }

  return kFaint;
}

std::string look_of(Zone::Kind kind) {
  return fmt::format("fill=\"{0}\" fill-opacity=\"0.16\" stroke=\"{0}\" stroke-width=\"1.2\"{1}", colour_of(kind),
                     kind == Zone::Kind::kNoStopping ? " stroke-dasharray=\"5 3\"" : "");
}

/// The middle of the box around the corners.
Point2 middle_of(const std::vector<Point2>& corners) {
  Point2 low = corners.front();
  Point2 high = corners.front();
  for (const Point2 corner : corners) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }

  return 0.5 * (low + high);
}

/// Half as long as the farthest corner is away from the middle, to both sides; its tip is two strokes.
std::string arrow_of(const MapFrame& frame, const Zone& zone, const std::vector<Point2>& corners) {
  const Point2 middle = middle_of(corners);
  double reach_m = 0.0;
  for (const Point2 corner : corners) reach_m = std::max(reach_m, geometry::distance(middle, corner));

  const Point2 along{std::cos(zone.direction_rad), std::sin(zone.direction_rad)};
  const PointPx from = frame.at(middle - (0.5 * reach_m) * along);
  const PointPx to = frame.at(middle + (0.5 * reach_m) * along);

  // In the picture y grows downwards.
  const auto beside = [&](double turn_rad) {
    const double angle_rad = zone.direction_rad + turn_rad;
    return PointPx{to.x + kTipPx * std::cos(angle_rad), to.y - kTipPx * std::sin(angle_rad)};
  };

  const double back_rad = 0.85 * geometry::kPi;
  const std::string d = path_along({from, to}) + path_along({beside(back_rad), to, beside(-back_rad)});

  return path(d, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\"", colour_of(zone.kind))) + "\n";
}

/// "bend, 0.4 m/s"
std::string label_of(const Zone& zone) {
  return zone.kind == Zone::Kind::kSpeed ? fmt::format("{}, {:g} m/s", zone.id, zone.max_speed_mps) : zone.id;
}

}  // namespace

std::string zones_layer(const MapFrame& frame, const std::vector<Zone>& zones) {
  std::string svg;
  for (const Zone& zone : zones) {
    const std::vector<Point2> corners = fleet::corners_of(zone);
    svg += path(path_along(frame, corners) + "z", look_of(zone.kind),
                fmt::format("{} zone {}", name(zone.kind), label_of(zone))) +
           "\n";

    if (zone.kind == Zone::Kind::kOneWay) svg += arrow_of(frame, zone, corners);
  }

  // Names lie over all zones.
  for (const Zone& zone : zones) {
    const PointPx at = frame.at(middle_of(fleet::corners_of(zone)));
    svg +=
        text(at.x, at.y - 4.0, fmt::format("text-anchor=\"middle\" font-size=\"11\" fill=\"{}\"", colour_of(zone.kind)),
             label_of(zone)) +
        "\n";
  }

  return svg;
}

std::string zones_legend(int x_px, int y_px, const std::vector<Zone>& zones) {
  Legend legend(x_px, y_px, 34, fmt::format("fill=\"{}\"", kInk));

  for (const Zone::Kind kind : {Zone::Kind::kKeepOut, Zone::Kind::kSpeed, Zone::Kind::kOneWay, Zone::Kind::kNoStopping,
                                Zone::Kind::kOneVehicle, Zone::Kind::kParking}) {
    const auto is_of_kind = [kind](const Zone& zone) { return zone.kind == kind; };
    if (std::any_of(zones.begin(), zones.end(), is_of_kind))
      legend.add(rect(2, -8, 26, 16, look_of(kind)), name(kind), kEntryPx);
  }

  return legend.svg();
}

std::string zones_picture(const grid::OccupancyGrid& grid, const std::vector<Zone>& zones) {
  const MapFrame frame = fitted_frame(grid.geometry(), kEdgePx);
  const GridLayers layers = grid_layers(grid);
  const int height_px = static_cast<int>(std::lround(frame.height_px()));

  const std::string body =
      path(boxes_path(frame, layers.unknown, Digits::kFine), fmt::format("fill=\"{}\"", kUnknown)) + "\n" +
      path(boxes_path(frame, layers.occupied, Digits::kFine), fmt::format("fill=\"{}\"", kWall)) + "\n" +
      zones_layer(frame, zones) + zones_legend(14, height_px + kLegendPx / 2, zones);

  Page page;
  page.width = static_cast<int>(std::lround(frame.width_px()));
  page.height = height_px + kLegendPx;
  page.attributes = std::string(kSansSerif) + " font-size=\"13\"";

  return document(page, body);
}

}  // namespace aisle::draw
