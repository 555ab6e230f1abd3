#include "tools/referee/report/fleet_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/map_frame.hpp"
#include "tools/draw/svg.hpp"
#include "tools/draw/walls.hpp"
#include "tools/draw/zones.hpp"
#include "tools/referee/report/style.hpp"

namespace aisle::referee {
namespace {

using draw::MapFrame;
using geometry::Point2;

constexpr double kWidthPx = 1400.0;
constexpr double kLargestHeightPx = 1050.0;
constexpr double kMarginPx = 28.0;
constexpr double kHeaderPx = 118.0;
constexpr double kAroundM = 3.0;
constexpr double kNearlyAll = 0.55;  // from this share of the map on, all of it is shown
constexpr double kStepPx = 6.0;      // between a person's dots
constexpr double kJumpM = 1.0;       // between two moments of a vehicle: it was set down anew
constexpr double kSamePlaceM = 0.2;  // goals nearer than this share a flag
constexpr double kLongestScalePx = 170.0;
constexpr double kZonesLegendPx = 26.0;  // below the other signs

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A rectangle of the map that grows around points.
struct Area {
  Point2 low{kInfinity, kInfinity};
  Point2 high{-kInfinity, -kInfinity};

  void hold(Point2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }

  double square_m() const { return std::max(0.0, high.x - low.x) * std::max(0.0, high.y - low.y); }
};

/// Where vehicles, goals and edits are; people may come from further away.
Area area_of(const RunReport& report, const Walls& walls) {
  Area busy;
  for (const auto& [id, vehicle] : report.vehicles) {
    for (const DrivePoint& point : vehicle.drive.trace()) busy.hold(point.base_in_map.position());
    for (const PlanTrace& plan : vehicle.plans) {
      for (const Point2 p : plan.waypoints_in_map) busy.hold(p);
    }
  }

  for (const GoalRecord& goal : report.goals) busy.hold(goal.pose_in_map.position());

  for (const EditRow& edit : report.edits) {
    for (const Point2 p : edit.outline_in_map) busy.hold(p);
  }

  // With some room around; all of the map when that is nearly all of it.
  Area all;
  all.hold(walls.low_in_map());
  all.hold(walls.high_in_map());

  Area shown;
  shown.hold({std::max(all.low.x, busy.low.x - kAroundM), std::max(all.low.y, busy.low.y - kAroundM)});
  shown.hold({std::min(all.high.x, busy.high.x + kAroundM), std::min(all.high.y, busy.high.y + kAroundM)});

  return busy.low.x > busy.high.x || shown.square_m() > kNearlyAll * all.square_m() ? all : shown;
}

/// As large as fits, in the middle of the picture.
MapFrame frame_of(const Area& area) {
  MapFrame frame{area.low, area.high, kMarginPx, kHeaderPx, 1.0};
  frame.px_per_m = std::min((kWidthPx - 2.0 * kMarginPx) / (area.high.x - area.low.x),
                            kLargestHeightPx / (area.high.y - area.low.y));
  frame.left_px = 0.5 * (kWidthPx - frame.width_px());

  return frame;
}

std::string filled(const char* colour) { return fmt::format("fill=\"{}\"", colour); }

/// White floor, dark walls; only what is shown.
std::string walls_layer(const MapFrame& f, const Walls& walls) {
  std::vector<draw::Box> shown;
  for (const WallBox& box : walls.boxes()) {
    const bool is_outside = box.high.x < f.low_in_map.x || box.low.x > f.high_in_map.x || box.high.y < f.low_in_map.y ||
                            box.low.y > f.high_in_map.y;
    if (!is_outside) shown.push_back({box.low, box.high});
  }

  return draw::rect(f.left_px, f.top_px, f.width_px(), f.height_px(),
                    fmt::format("fill=\"#ffffff\" stroke=\"{}\"", draw::kBorder)) +
         "\n" +
         draw::path(draw::boxes_path(f, shown, draw::Digits::kTenth),
                    "fill=\"#3e4c59\" shape-rendering=\"crispEdges\"") +
         "\n";
}

/// Hatched areas, with their names under the pointer.
std::string edits_layer(const MapFrame& f, const std::vector<EditRow>& edits) {
  std::string svg;
  for (const EditRow& edit : edits) {
    if (edit.outline_in_map.empty()) continue;

    svg += draw::path(draw::path_along(f, edit.outline_in_map) + "z",
                      fmt::format("fill=\"url(#{})\" stroke=\"{}\" stroke-width=\"1.5\"",
                                  edit.block ? "blocked" : "freed", edit.block ? kBlocked : kGood),
                      fmt::format("{} {}: {} at {:.1f} s", edit.block ? "block" : "unblock", edit.edit_id, edit.outcome,
                                  edit.asked_s)) +
           "\n";
  }

  return svg;
}

/// A disc or a turned rectangle.
std::string outline(const MapFrame& f, const Shape& shape, const geometry::Pose2& middle_in_map,
                    const std::string& attributes) {
  const double rim_m = 2.0 * shape.radius_m;
  return (shape.is_disc()
              ? draw::disc(f, middle_in_map.position(), shape.radius_m, attributes)
              : draw::turned_rect(f, middle_in_map, shape.length_m + rim_m, shape.width_m + rim_m, attributes)) +
         "\n";
}

/// One dot for each place, however often the person walked there: dashes that overlap would look like a line.
std::string steps(const MapFrame& f, const BodyTrace& body) {
  std::set<std::pair<long, long>> visited;
  const double step_m = kStepPx / f.px_per_m;
  std::string dots;
  std::optional<Point2> last;

  for (const auto& [t_s, pose] : body.way) {
    if (last && geometry::distance(pose.position(), *last) < step_m) continue;
    last = pose.position();
    if (!visited.emplace(std::lround(last->x / step_m), std::lround(last->y / step_m)).second) continue;
    dots += fmt::format("M{:.1f} {:.1f}h0", f.x(last->x), f.y(last->y));
  }

  return draw::path(dots, "fill=\"none\" stroke=\"#9b7fc0\" stroke-width=\"2.6\" stroke-linecap=\"round\"") + "\n";
}

/// Persons with their steps, and hidden blocks.
std::string bodies_layer(const MapFrame& f, const RunReport& report) {
  std::string svg;
  for (const auto& [id, body] : report.bodies) {
    if (body.way.empty()) continue;

    const geometry::Pose2& last = body.way.back().second;
    if (body.kind == BodyKind::kBlock)
      svg += outline(f, body.shape, last, "fill=\"#8d6e63\" stroke=\"#4e342e\" stroke-width=\"1.5\"");
    else
      svg += steps(f, body) + outline(f, body.shape, last, "fill=\"#9b7fc0\" fill-opacity=\"0.45\" stroke=\"#6b46a3\"");
  }

  return svg;
}

/// All plans, dashed.
std::string plans_layer(const MapFrame& f, const VehicleRow& vehicle, const char* colour) {
  std::string svg;
  for (const PlanTrace& plan : vehicle.plans)
    svg += draw::path(draw::path_along(f, plan.waypoints_in_map),
                      fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1\" stroke-opacity=\"0.75\" "
                                  "stroke-dasharray=\"6 3\"",
                                  colour)) +
           "\n";

  return svg;
}

/// Where the vehicle jumped (set down anew after a restart of the simulation) the line is cut.
std::string way_layer(const MapFrame& f, const VehicleRow& vehicle, const char* colour) {
  const std::string attributes = fmt::format(
      "fill=\"none\" stroke=\"{}\" stroke-width=\"3.6\" stroke-opacity=\"0.8\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\"",
      colour);

  std::string svg;
  std::vector<Point2> piece;

  const auto flush = [&] {
    if (piece.size() > 1) svg += draw::path(draw::path_along(f, piece), attributes) + "\n";
    piece.clear();
  };

  for (const DrivePoint& point : vehicle.drive.trace()) {
    if (!piece.empty() && geometry::distance(piece.back(), point.base_in_map.position()) > kJumpM) flush();
    piece.push_back(point.base_in_map.position());
  }

  flush();
  return svg;
}

/// The outline, and a line to its nose.
std::string vehicle_at(const MapFrame& f, const VehicleRow& vehicle, const geometry::Pose2& base_in_map,
                       const char* colour, double opacity) {
  const double line_opacity = std::min(1.0, opacity + 0.45);
  const double nose_m =
      vehicle.ahead_m + (vehicle.shape.is_disc() ? vehicle.shape.radius_m : 0.5 * vehicle.shape.length_m);

  return outline(
             f, vehicle.shape, middle_in_map(base_in_map, vehicle.ahead_m),
             fmt::format("fill=\"{0}\" fill-opacity=\"{1}\" stroke=\"{0}\" stroke-opacity=\"{2}\" stroke-width=\"1.1\"",
                         colour, opacity, line_opacity)) +
         draw::line(f, base_in_map.position(), geometry::to_map(base_in_map, {nose_m, 0.0}),
                    fmt::format("stroke=\"{}\" stroke-width=\"1.4\" stroke-opacity=\"{}\"", colour, line_opacity)) +
         "\n";
}

/// Faint now and then on the way, full at the end with the name below; goals' flags stand above.
std::string vehicle_layer(const MapFrame& f, const VehicleRow& vehicle, const char* colour) {
  const std::vector<DrivePoint>& trace = vehicle.drive.trace();
  if (trace.empty()) return "";

  std::string svg;
  double next_s = trace.front().t_s;
  std::optional<Point2> last;

  for (const DrivePoint& point : trace) {
    const Point2 here = point.base_in_map.position();
    if (point.t_s < next_s || (last && geometry::distance(here, *last) < vehicle.shape.reach_m())) continue;

    svg += vehicle_at(f, vehicle, point.base_in_map, colour, 0.10);
    next_s = point.t_s + kOutlineEvery_s;
    last = here;
  }

  // Where it stands at the end.
  const geometry::Pose2& end = vehicle.drive.base_in_map();
  const double down_px = vehicle.shape.reach_m() * f.px_per_m + 14.0;

  return svg + vehicle_at(f, vehicle, end, colour, 0.85) +
         draw::text(f.x(end.x), f.y(end.y) + down_px,
                    fmt::format("text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\" fill=\"{}\" "
                                "stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"",
                                colour),
                    vehicle.agv_id) +
         "\n";
}

/// The goals of one vehicle at one place.
struct Flag {
  Point2 at_in_map;
  std::string label;  // "1 4": a place that is visited twice has one flag; "2!": missed
};

/// Goals are numbered in the order in which they were given.
std::vector<Flag> flags_of(const std::vector<GoalRecord>& goals, const std::string& agv_id) {
  std::vector<Flag> flags;
  int number = 0;

  for (const GoalRecord& goal : goals) {
    if (goal.agv_id != agv_id) continue;

    const Point2 at = goal.pose_in_map.position();
    const std::string label = std::to_string(++number) + (goal.outcome == GoalOutcome::kReached ? "" : "!");
    const auto same = std::find_if(flags.begin(), flags.end(), [&](const Flag& flag) {
      return geometry::distance(flag.at_in_map, at) < kSamePlaceM;
    });

    if (same == flags.end())
      flags.push_back({at, label});
    else
      same->label += " " + label;
  }

  return flags;
}

/// A flag on a pole for each place.
std::string goals_layer(const MapFrame& f, const std::vector<GoalRecord>& goals, const std::string& agv_id,
                        const char* colour) {
  std::string svg;
  for (const Flag& flag : flags_of(goals, agv_id)) {
    const bool is_missed = flag.label.find('!') != std::string::npos;
    const double width_px = 10.0 + 7.0 * static_cast<double>(flag.label.size());
    const draw::PointPx at = f.at(flag.at_in_map);

    svg += draw::path(fmt::format("M{:.1f} {:.1f}v-19", at.x, at.y),
                      fmt::format("stroke=\"{}\" stroke-width=\"2\"", colour)) +
           draw::circle(at.x, at.y, 3, filled(colour)) +
           draw::rect(at.x, at.y - 33.0, width_px, 15,
                      fmt::format("rx=\"2\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"",
                                  is_missed ? "#ffffff" : colour, colour)) +
           draw::text(at.x + 0.5 * width_px, at.y - 21.5,
                      fmt::format("font-size=\"11\" font-weight=\"bold\" text-anchor=\"middle\" fill=\"{}\"",
                                  is_missed ? draw::kAlarm : "#ffffff"),
                      flag.label) +
           "\n";
  }

  return svg;
}

/// A red cross in a ring, with the two names under the pointer.
std::string contacts_layer(const MapFrame& f, const std::vector<Contact>& contacts) {
  std::string svg;
  for (const Contact& contact : contacts) {
    const draw::PointPx at = f.at(contact.at_in_map);
    const std::string title = fmt::format("{} and {} at {:.2f} s", contact.a, contact.b, contact.begin_s);

    svg += fmt::format("<g stroke=\"{}\" stroke-width=\"3.5\" fill=\"none\">", draw::kAlarm) +
           draw::circle(at.x, at.y, 13, "") +
           draw::path(fmt::format("M{:.1f} {:.1f}l10 10m0 -10l-10 10", at.x - 5.0, at.y - 5.0), "") + "<title>" +
           draw::escaped(title) + "</title></g>\n";
  }

  return svg;
}

/// A figure of the header; red when it is bad.
struct Tile {
  std::string name;
  std::string value;
  bool alarm{false};
};

/// The ten figures that a reader looks for first.
std::vector<Tile> tiles_of(const RunReport& report) {
  const int reached = report.count(GoalOutcome::kReached);
  const std::optional<double> least_m = report.clearances.overall_m();
  const auto p99 = [](const Distribution& d) {
    return d.count() == 0 ? std::string("-") : fmt::format("{:.1f} ms", *d.quantile(0.99));
  };

  return {{"goals reached", fmt::format("{} of {}", reached, report.goals_expected), report.goals_missed() > 0},
          {"contacts", std::to_string(report.contacts.size()), !report.contacts.empty()},
          {"least clearance", least_m ? fmt::format("{:.2f} m", *least_m) : "-", least_m && *least_m <= 0.0},
          {"driven", fmt::format("{:.0f} m", report.distance_m()), false},
          {"time", fmt::format("{:.0f} s", report.duration_s), false},
          {"stops", std::to_string(report.stops()), false},
          {"replans", std::to_string(report.replans()), false},
          {"planning p99", p99(report.planning_ms), false},
          {"control p99", p99(report.control_ms), false},
          {"scan to command p99", p99(report.scan_to_command_ms()), false}};
}

/// Name and verdict, with the figures below.
std::string header(const RunReport& report) {
  const auto margin_px = static_cast<int>(kMarginPx), width_px = static_cast<int>(kWidthPx);

  std::string svg =
      draw::text(margin_px, 38, fmt::format("font-size=\"23\" font-weight=\"bold\" fill=\"{}\"", draw::kInk),
                 report.scenario) +
      "\n" +
      fmt::format(
          "<text x=\"{}\" y=\"38\" font-size=\"14\" text-anchor=\"end\" fill=\"{}\">{} vehicles, seed {} "
          "\xC2\xB7 <tspan font-weight=\"bold\" fill=\"{}\">{}</tspan></text>\n",
          width_px - margin_px, draw::kFaint, report.vehicles.size(), report.seed,
          report.passed() ? kGood : draw::kAlarm, report.passed() ? "passed" : "failed");

  const std::vector<Tile> tiles = tiles_of(report);
  const double step_px = (kWidthPx - 2.0 * kMarginPx) / static_cast<double>(tiles.size());

  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const double x = kMarginPx + step_px * static_cast<double>(i);
    svg += draw::text(x, 78,
                      fmt::format("font-size=\"20\" font-weight=\"bold\" fill=\"{}\"",
                                  tiles[i].alarm ? draw::kAlarm : draw::kInk),
                      tiles[i].value) +
           draw::text(x, 97, fmt::format("font-size=\"11.5\" fill=\"{}\"", draw::kFaint), tiles[i].name) + "\n";
  }

  return svg;
}

/// A bar of a round length below the map.
std::string scale(const MapFrame& f) {
  double length_m = 1.0;
  for (const double candidate_m : {2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (candidate_m * f.px_per_m <= kLongestScalePx) length_m = candidate_m;
  }

  const double y_px = f.top_px + f.height_px() + 22.0;
  const double left_px = kWidthPx - kMarginPx - length_m * f.px_per_m;

  return draw::scale_bar(f, left_px, y_px - 4.0, length_m,
                         fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"", draw::kFaint)) +
         draw::text(left_px + 0.5 * length_m * f.px_per_m, y_px + 18.0,
                    fmt::format("font-size=\"12\" text-anchor=\"middle\" fill=\"{}\"", draw::kFaint),
                    fmt::format("{:.0f} m", length_m)) +
         "\n";
}

/// What the signs mean, in one line.
std::string signs(double y_px) {
  draw::Legend legend(kMarginPx, y_px, 36, fmt::format("font-size=\"12.5\" fill=\"{}\"", draw::kInk));
  legend.add("<path d=\"M0 0h28\" stroke=\"#52606d\" stroke-width=\"3.6\" stroke-linecap=\"round\"/>", "driven", 98);
  legend.add("<path d=\"M0 0h28\" stroke=\"#52606d\" stroke-width=\"1\" stroke-dasharray=\"6 3\"/>", "planned", 106);
  legend.add(
      "<circle cx=\"14\" r=\"8\" fill=\"#52606d\" fill-opacity=\"0.12\" stroke=\"#52606d\"/><path d=\"M14 0h8\" "
      "stroke=\"#52606d\"/>",
      "vehicle every 3 s", 166);
  legend.add(
      "<path d=\"M2 0h26\" stroke=\"#9b7fc0\" stroke-width=\"2.4\" stroke-linecap=\"round\" stroke-dasharray=\"0.1 "
      "5\"/>",
      "person", 100);
  legend.add("<rect x=\"6\" y=\"-8\" width=\"16\" height=\"16\" fill=\"#8d6e63\" stroke=\"#4e342e\"/>", "hidden block",
             134);
  legend.add("<rect x=\"2\" y=\"-8\" width=\"26\" height=\"16\" fill=\"url(#blocked)\" stroke=\"#b7791f\"/>",
             "blocked in the map", 176);
  legend.add(
      "<path d=\"M8 9v-17\" stroke=\"#52606d\" stroke-width=\"2\"/><rect x=\"8\" y=\"-9\" width=\"15\" height=\"10\" "
      "fill=\"#52606d\"/>",
      "goal", 84);
  legend.add(
      fmt::format("<circle cx=\"14\" r=\"8\" fill=\"none\" stroke=\"{0}\" stroke-width=\"3\"/><path d=\"M11 -3l6 6m0 "
                  "-6l-6 6\" stroke=\"{0}\" stroke-width=\"2\"/>",
                  draw::kAlarm),
      "contact", 100);

  return legend.svg();
}

/// Drawn rows, and where the next one would begin.
struct Rows {
  std::string svg;
  double bottom_px;
};

/// Each vehicle's colour, name and figures, as many in a row as fit.
Rows vehicle_rows(double y_px, const RunReport& report) {
  constexpr double kEntryPx = 268.0, kRowPx = 22.0, kLastEntryPx = 260.0;
  Rows rows{"", y_px};
  double x_px = kMarginPx;
  std::size_t index = 0;

  for (const auto& [id, vehicle] : report.vehicles) {
    if (x_px > kWidthPx - kMarginPx - kLastEntryPx) {
      x_px = kMarginPx;
      rows.bottom_px += kRowPx;
    }

    rows.svg += draw::rect(x_px, rows.bottom_px - 11.0, 14, 14,
                           fmt::format("rx=\"3\" fill=\"{}\"", draw::colour(index++, kVehicleColours))) +
                fmt::format(
                    "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12.5\" fill=\"{}\"><tspan "
                    "font-weight=\"bold\">{}</tspan> {:.0f} m, {} stops, {} replans</text>\n",
                    x_px + 20.0, rows.bottom_px, draw::kInk, draw::escaped(id), vehicle.drive.distance_m(),
                    vehicle.drive.stops(), vehicle.replans);

    x_px += kEntryPx;
  }

  rows.bottom_px += kRowPx;
  return rows;
}

/// All vehicles' drawings of one kind; those of the next kind lie over them.
template <class Draw>
std::string each_vehicle(const RunReport& report, const Draw& drawing) {
  std::string svg;
  std::size_t index = 0;
  for (const auto& [id, vehicle] : report.vehicles) svg += drawing(vehicle, draw::colour(index++, kVehicleColours));
  return svg;
}

constexpr const char* kPatterns =
    "<defs><pattern id=\"blocked\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" "
    "patternTransform=\"rotate(45)\">"
    "<rect width=\"8\" height=\"8\" fill=\"#fdf3dc\"/><rect width=\"3\" height=\"8\" fill=\"#e0a030\"/></pattern>"
    "<pattern id=\"freed\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">"
    "<rect width=\"8\" height=\"8\" fill=\"#e6f4ea\"/><rect width=\"2\" height=\"8\" "
    "fill=\"#68b684\"/></pattern></defs>\n";

}  // namespace

/// Layer by layer from below: walls, zones, edits, people and blocks, plans, ways, vehicles, goals, contacts;
/// then header and legend outside the map.
std::string fleet_svg(const RunReport& report, const Walls& walls, const std::vector<fleet::Zone>& zones) {
  const MapFrame f = frame_of(area_of(report, walls));
  std::string body = "<clipPath id=\"shown\">" + draw::rect(f.left_px, f.top_px, f.width_px(), f.height_px(), "") +
                     "</clipPath><g clip-path=\"url(#shown)\">\n";

  body += walls_layer(f, walls) + draw::zones_layer(f, zones) + edits_layer(f, report.edits) + bodies_layer(f, report);
  body += each_vehicle(report, [&](const VehicleRow& v, const char* colour) { return plans_layer(f, v, colour); });
  body += each_vehicle(report, [&](const VehicleRow& v, const char* colour) { return way_layer(f, v, colour); });
  body += each_vehicle(report, [&](const VehicleRow& v, const char* colour) { return vehicle_layer(f, v, colour); });
  body += each_vehicle(
      report, [&](const VehicleRow& v, const char* colour) { return goals_layer(f, report.goals, v.agv_id, colour); });
  body += contacts_layer(f, report.contacts) + "</g>\n";

  const double legend_px = f.top_px + f.height_px() + 24.0;
  const double zones_px = zones.empty() ? 0.0 : kZonesLegendPx;
  const Rows rows = vehicle_rows(legend_px + 30.0 + zones_px, report);

  body += header(report) + scale(f) + signs(legend_px) + rows.svg;
  body += draw::zones_legend(static_cast<int>(kMarginPx), static_cast<int>(legend_px + kZonesLegendPx), zones);
  return draw::document({static_cast<int>(kWidthPx), static_cast<int>(std::lround(rows.bottom_px)), kFont, kPatterns},
                        body);
}

}  // namespace aisle::referee
