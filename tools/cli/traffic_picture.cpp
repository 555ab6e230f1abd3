#include "tools/cli/traffic_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/map_frame.hpp"
#include "tools/draw/svg.hpp"
#include "tools/draw/walls.hpp"
#include "tools/draw/zones.hpp"

namespace aisle::cli {
namespace {

using geometry::Point2;

constexpr double kEdgePx = 1200.0;
constexpr int kLegendPx = 30;
constexpr int kZonesLegendPx = 340;  // to the right of the other entries
constexpr double kMiddlePx = 15.0;   // of the legend, below its upper edge
constexpr const char* kArrowTip =
    "<defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" "
    "orient=\"auto\"><path d=\"M 0 0 L 8 4 L 0 8 z\" fill=\"{}\"/></marker></defs>";

std::string stroke(const char* colour, const char* width, const char* more = "") {
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}", colour, width, more);
}

std::string way_of(const draw::MapFrame& frame, const DrawnVehicle& vehicle, const char* colour) {
  const std::vector<Point2> ahead = part_of(vehicle.way_in_map, vehicle.driven_m, 1e9);
  const std::vector<Point2> granted = part_of(vehicle.way_in_map, vehicle.driven_m, vehicle.granted_m);

  std::string svg;
  if (ahead.size() > 1) svg += draw::polyline(frame, ahead, stroke(colour, "1.2", " stroke-dasharray=\"4 3\"")) + "\n";
  if (granted.size() > 1)
    svg += draw::polyline(frame, granted, stroke(colour, "5", " stroke-linecap=\"round\" opacity=\"0.55\"")) + "\n";
  return svg;
}

std::string body_of(const draw::MapFrame& frame, const DrawnVehicle& vehicle, const char* colour) {
  const geometry::Footprint& footprint = vehicle.footprint;
  const geometry::Pose2& base = vehicle.base_in_map;
  const std::string look = fmt::format("fill=\"{}\" stroke=\"{}\"", colour, draw::kInk);

  std::string svg;
  if (footprint.is_disc()) {
    svg = draw::disc(frame, base.position(), footprint.radius_m, look);
  } else {
    const geometry::Body body = geometry::body_of(footprint, base);
    svg = draw::turned_rect(frame, body.base_in_map, body.length_m, body.width_m, look);
  }

  const draw::PointPx at = frame.at(base.position());
  return svg + "\n" + draw::text(at.x + 8.0, at.y - 8.0, fmt::format("fill=\"{}\"", draw::kInk), vehicle.agv_id) + "\n";
}

/// To the waited-for vehicle's place; none when that is not known.
std::string arrow_of(const draw::MapFrame& frame, const DrawnVehicle& vehicle,
                     const std::vector<DrawnVehicle>& vehicles) {
  const auto other = std::find_if(vehicles.begin(), vehicles.end(),
                                  [&](const DrawnVehicle& one) { return one.agv_id == vehicle.waits_for; });
  if (vehicle.waits_for.empty() || other == vehicles.end()) return "";

  const std::string d =
      draw::path_along({frame.at(vehicle.base_in_map.position()), frame.at(other->base_in_map.position())});
  return draw::path(d, stroke(draw::kAlarm, "1.6", " marker-end=\"url(#tip)\""),
                    vehicle.agv_id + " waits for " + other->agv_id) +
         "\n";
}

std::string legend_at(double top_px) {
  draw::Legend legend(14, top_px + kMiddlePx, 22, fmt::format("fill=\"{}\"", draw::kInk));
  legend.add(draw::path("M -12 0 L 12 0", stroke(draw::kInk, "1.2", " stroke-dasharray=\"4 3\"")), "plan", 90);
  legend.add(draw::path("M -12 0 L 12 0", stroke(draw::kInk, "5", " opacity=\"0.55\"")), "granted", 110);
  legend.add(draw::path("M -12 0 L 12 0", stroke(draw::kAlarm, "1.6", " marker-end=\"url(#tip)\"")), "waits for", 110);
  return legend.svg();
}

}  // namespace

/// Walks along the legs; each gives what of it lies between the two lengths.
std::vector<Point2> part_of(const std::vector<Point2>& way, double from_m, double to_m) {
  std::vector<Point2> part;
  if (to_m <= from_m) return part;

  double begin_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Point2 leg = way[i] - way[i - 1];
    const double length_m = std::hypot(leg.x, leg.y);
    const double end_m = begin_m + length_m;

    if (length_m > 0.0 && end_m > from_m && begin_m < to_m) {
      const auto at = [&](double s_m) { return way[i - 1] + ((s_m - begin_m) / length_m) * leg; };
      if (part.empty()) part.push_back(at(std::max(from_m, begin_m)));
      part.push_back(at(std::min(to_m, end_m)));
    }

    begin_m = end_m;
  }

  return part;
}

/// From the floor up: walls, zones, ways, vehicles, arrows.
std::string traffic_svg(const grid::OccupancyGrid& grid, const std::vector<DrawnVehicle>& vehicles,
                        const std::vector<fleet::Zone>& zones) {
  const draw::MapFrame frame = draw::fitted_frame(grid.geometry(), kEdgePx);
  const draw::GridLayers layers = draw::grid_layers(grid);

  std::string body = draw::path(draw::boxes_path(frame, layers.unknown, draw::Digits::kFine),
                                fmt::format("fill=\"{}\"", draw::kUnknown)) +
                     "\n" +
                     draw::path(draw::boxes_path(frame, layers.occupied, draw::Digits::kFine),
                                fmt::format("fill=\"{}\"", draw::kWall)) +
                     "\n";

  body += draw::zones_layer(frame, zones);
  for (std::size_t i = 0; i < vehicles.size(); ++i) body += way_of(frame, vehicles[i], draw::colour(i));
  for (std::size_t i = 0; i < vehicles.size(); ++i) body += body_of(frame, vehicles[i], draw::colour(i));
  for (const DrawnVehicle& vehicle : vehicles) body += arrow_of(frame, vehicle, vehicles);
  body += legend_at(frame.height_px());
  body += draw::zones_legend(kZonesLegendPx, static_cast<int>(frame.height_px() + kMiddlePx), zones);

  draw::Page page;
  page.width = static_cast<int>(std::lround(frame.width_px()));
  page.height = static_cast<int>(std::lround(frame.height_px())) + kLegendPx;
  page.attributes = std::string(draw::kSansSerif) + " font-size=\"13\"";
  page.definitions = fmt::format(fmt::runtime(kArrowTip), draw::kAlarm);
  return draw::document(page, body);
}

}  // namespace aisle::cli
