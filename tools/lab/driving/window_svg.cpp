#include "tools/lab/driving/window_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/map_frame.hpp"
#include "tools/draw/walls.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;

constexpr double kPxPerM = 42.0;
constexpr int kTopPx = 34;
constexpr int kBottomPx = 40;
constexpr double kLookS = 0.1;             // between two points of a way
constexpr std::size_t kOutlineEvery = 20;  // points: two seconds
constexpr double kOutlineApartM = 0.5;     // nearer to the one before, none is drawn
constexpr double kScaleM = 2.0;
constexpr const char* kVehicle = "#0072b2";
constexpr const char* kMover = "#d55e00";
constexpr const char* kSubTarget = "#1b7837";
constexpr const char* kBox = "fill=\"#8d6e63\"";
constexpr const char* kNearest = "#b2182b";

/// Where a way's times stand, from the outline's middle.
struct Beside {
  double dx_px, dy_px;
  const char* anchor;
};

std::string filled(const char* colour) { return fmt::format("fill=\"{}\"", colour); }

/// Outlines with their times, and the line through all points over them.
std::string way(const draw::MapFrame& frame, const std::vector<Point2>& points, double radius_m, const char* colour,
                const Beside& beside) {
  std::string outlines;
  std::optional<Point2> last;

  for (std::size_t i = 0; i < points.size(); i += kOutlineEvery) {
    const Point2 p = points[i];
    if (last && geometry::distance(p, *last) < kOutlineApartM) continue;

    last = p;

    outlines +=
        draw::disc(frame, p, radius_m,
                   fmt::format("fill=\"{0}\" fill-opacity=\"0.12\" stroke=\"{0}\" stroke-width=\"0.8\"", colour)) +
        draw::text(frame.x(p.x) + beside.dx_px, frame.y(p.y) + beside.dy_px,
                   fmt::format("font-size=\"11\" text-anchor=\"{}\" fill=\"{}\"", beside.anchor, colour),
                   fmt::format("{:.0f} s", kLookS * static_cast<double>(i))) +
        "\n";
  }

  const std::string stroke =
      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"", colour);
  return outlines + draw::polyline(frame, points, stroke) + "\n";
}

std::string aims(const draw::MapFrame& frame, const WindowScene& scene) {
  const std::string stroke = fmt::format("stroke=\"{}\" stroke-width=\"0.5\" opacity=\"0.6\"", kSubTarget);
  std::string svg;

  for (const WindowScene::Aimed& aimed : scene.sub_targets)
    svg += draw::line(frame, aimed.from_in_map, aimed.at_in_map, stroke) +
           draw::circle(frame.x(aimed.at_in_map.x), frame.y(aimed.at_in_map.y), 2.5, filled(kSubTarget)) + "\n";

  return svg;
}

std::string nearest(const draw::MapFrame& frame, const WindowScene& scene) {
  const std::size_t moments = std::min(scene.driven_in_map.size(), scene.mover_in_map.size());
  if (moments == 0) return "";

  std::size_t best = 0;
  const auto apart_m = [&](std::size_t i) { return geometry::distance(scene.driven_in_map[i], scene.mover_in_map[i]); };

  for (std::size_t i = 1; i < moments; ++i)
    if (apart_m(i) < apart_m(best)) best = i;

  const double gap_m = apart_m(best) - scene.vehicle_radius_m - scene.mover_radius_m;
  return draw::line(frame, scene.driven_in_map[best], scene.mover_in_map[best],
                    fmt::format("stroke=\"{}\" stroke-width=\"1.5\" stroke-dasharray=\"3 2\"", kNearest)) +
         draw::text(frame.width_px() - 12.0, kTopPx + 22.0,
                    fmt::format("font-size=\"12\" text-anchor=\"end\" fill=\"{}\"", kNearest),
                    fmt::format("nearest: {:.2f} m between the outlines, at {:.1f} s", gap_m,
                                kLookS * static_cast<double>(best))) +
         "\n";
}

std::string end_mark(const draw::MapFrame& frame, Point2 at_in_map, const char* name) {
  const draw::PointPx at = frame.at(at_in_map);
  return draw::path(fmt::format("M{:.1f} {:.1f}l5 5m0 -10l-10 10m0 -10l5 5", at.x, at.y),
                    fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", draw::kSoftInk)) +
         draw::text(at.x, at.y + 34.0, fmt::format("text-anchor=\"middle\" fill=\"{}\"", draw::kSoftInk), name) + "\n";
}

std::string legend(const draw::MapFrame& frame, const WindowScene& scene) {
  constexpr int kEntryPx = 190;
  const double y_px = kTopPx + frame.height_px() + 24.0;
  draw::Legend legend(10, static_cast<int>(std::lround(y_px)), 34, filled(draw::kSoftInk));

  const auto stroke = [](const char* colour, const char* dashes) {
    return draw::path("M0 0h26",
                      fmt::format("stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\"", colour, dashes));
  };

  legend.add(stroke(draw::kFaint, "6 4"), "path", kEntryPx);
  legend.add(stroke(kVehicle, "none"), "vehicle, every 2 s", kEntryPx);
  if (!scene.mover_in_map.empty()) legend.add(stroke(kMover, "none"), "mover, every 2 s", kEntryPx);
  if (!scene.sub_targets.empty()) legend.add(stroke(kSubTarget, "none"), "local sub-target", kEntryPx);
  if (!scene.boxes.empty()) legend.add(draw::rect(5, -8, 16, 16, kBox), "box, not in the map", kEntryPx);

  const double bar_px = frame.width_px() - 10.0 - kScaleM * frame.px_per_m;
  return legend.svg() +
         draw::scale_bar(frame, bar_px, y_px - 6.0, kScaleM,
                         fmt::format("fill=\"none\" stroke=\"{}\"", draw::kSoftInk)) +
         draw::text(bar_px - 8.0, y_px + 4.0, fmt::format("text-anchor=\"end\" fill=\"{}\"", draw::kSoftInk),
                    fmt::format("{:.0f} m", kScaleM)) +
         "\n";
}

std::string boxes(const draw::MapFrame& frame, const std::vector<WindowScene::Box>& boxes) {
  std::string svg;
  for (const WindowScene::Box& box : boxes)
    svg += draw::rect(frame.x(box.low_in_map.x), frame.y(box.high_in_map.y),
                      (box.high_in_map.x - box.low_in_map.x) * frame.px_per_m,
                      (box.high_in_map.y - box.low_in_map.y) * frame.px_per_m, kBox) +
           "\n";

  return svg;
}

/// The mover's way and the vehicle's over it; their times stand where the other way does not run.
std::string ways(const draw::MapFrame& frame, const WindowScene& scene) {
  const std::vector<Point2>& mover = scene.mover_in_map;
  const bool is_across =
      mover.empty() || std::abs(mover.back().y - mover.front().y) > std::abs(mover.back().x - mover.front().x);
  const double mover_px = scene.mover_radius_m * frame.px_per_m;
  const double vehicle_px = scene.vehicle_radius_m * frame.px_per_m;

  return way(frame, mover, scene.mover_radius_m, kMover,
             is_across ? Beside{mover_px + 4.0, 4.0, "start"} : Beside{0.0, -mover_px - 4.0, "middle"}) +
         way(frame, scene.driven_in_map, scene.vehicle_radius_m, kVehicle,
             {0.0, is_across ? -vehicle_px - 4.0 : vehicle_px + 13.0, "middle"});
}

}  // namespace

/// From below: walls, the straight path, boxes, sub-targets, ways, the nearest moment; then the ends
/// and the legend.
std::string window_svg(const grid::OccupancyGrid& grid, const WindowScene& scene) {
  const draw::MapFrame frame = draw::frame_of(grid.geometry(), kPxPerM, kTopPx);
  const std::string title =
      draw::text(10, 22, fmt::format("font-size=\"15\" font-weight=\"bold\" fill=\"{}\"", draw::kSoftInk), scene.title);
  const std::string walls =
      draw::path(draw::boxes_path(frame, draw::obstacles(grid), draw::Digits::kTenth), filled(draw::kWall));

  const std::string path =
      draw::line(frame, scene.start_in_map, scene.goal_in_map,
                 fmt::format("stroke=\"{}\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"", draw::kFaint));

  return draw::document({static_cast<int>(std::lround(frame.width_px())),
                         static_cast<int>(std::lround(kTopPx + frame.height_px() + kBottomPx)),
                         std::string(draw::kSansSerif) + " font-size=\"13\""},
                        title + "\n" + walls + "\n" + path + "\n" + boxes(frame, scene.boxes) + aims(frame, scene) +
                            ways(frame, scene) + nearest(frame, scene) + end_mark(frame, scene.start_in_map, "start") +
                            end_mark(frame, scene.goal_in_map, "goal") + legend(frame, scene));
}

}  // namespace aisle::lab
