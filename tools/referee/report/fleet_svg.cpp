#include "tools/referee/report/fleet_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "tools/referee/report/picture.hpp"

namespace aisle::referee {
namespace {

using geometry::Point2;
using Out = std::back_insert_iterator<std::string>;

constexpr double kWidth_px = 1400.0;
constexpr double kLargest_height_px = 1050.0;
constexpr double kMargin_px = 28.0;
constexpr double kHeader_px = 118.0;
constexpr double kAround_m = 3.0;
/// From this share of the map on, all of it is shown.
constexpr double kNearlyAll = 0.55;

struct Area {
  Point2 low{1e18, 1e18};
  Point2 high{-1e18, -1e18};
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
  Area all;
  all.hold(walls.low_in_map());
  all.hold(walls.high_in_map());
  Area shown;
  shown.hold({std::max(all.low.x, busy.low.x - kAround_m), std::max(all.low.y, busy.low.y - kAround_m)});
  shown.hold({std::min(all.high.x, busy.high.x + kAround_m), std::min(all.high.y, busy.high.y + kAround_m)});
  return busy.low.x > busy.high.x || shown.square_m() > kNearlyAll * all.square_m() ? all : shown;
}

Frame frame_of(const Area& area) {
  Frame frame{area.low, area.high, kMargin_px, kHeader_px, 1.0};
  frame.px_per_m = std::min((kWidth_px - 2.0 * kMargin_px) / (area.high.x - area.low.x),
                            kLargest_height_px / (area.high.y - area.low.y));
  frame.left_px = 0.5 * (kWidth_px - frame.width_px());
  return frame;
}

void draw_walls(Out out, const Frame& f, const Walls& walls) {
  fmt::format_to(
      out, "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#ffffff\" stroke=\"#cbd2d9\"/>\n",
      f.left_px, f.top_px, f.width_px(), f.height_px());
  fmt::format_to(out, "<path fill=\"#3e4c59\" shape-rendering=\"crispEdges\" d=\"");
  for (const WallBox& box : walls.boxes()) {
    if (box.high.x < f.low_in_map.x || box.low.x > f.high_in_map.x || box.high.y < f.low_in_map.y ||
        box.low.y > f.high_in_map.y)
      continue;
    fmt::format_to(out, "M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", f.x(box.low.x), f.y(box.high.y),
                   (box.high.x - box.low.x) * f.px_per_m, (box.high.y - box.low.y) * f.px_per_m,
                   -(box.high.x - box.low.x) * f.px_per_m);
  }
  fmt::format_to(out, "\"/>\n");
}

void draw_edits(Out out, const Frame& f, const std::vector<EditRow>& edits) {
  for (const EditRow& edit : edits) {
    if (edit.outline_in_map.empty()) continue;
    fmt::format_to(out,
                   "<path d=\"{}z\" fill=\"url(#{})\" stroke=\"{}\" stroke-width=\"1.5\"><title>{} {}: {} at {:.1f} "
                   "s</title></path>\n",
                   path_of(f, edit.outline_in_map), edit.block ? "blocked" : "freed",
                   edit.block ? "#b7791f" : "#2f855a", edit.block ? "block" : "unblock", escaped(edit.edit_id),
                   escaped(edit.outcome), edit.asked_s);
  }
}

std::string outline_path(const Frame& f, const Shape& shape, const geometry::Pose2& pose) {
  const double l = 0.5 * shape.length_m + shape.radius_m;
  const double w = 0.5 * shape.width_m + shape.radius_m;
  return path_of(f, {geometry::to_map(pose, {l, w}), geometry::to_map(pose, {-l, w}), geometry::to_map(pose, {-l, -w}),
                     geometry::to_map(pose, {l, -w})}) +
         "z";
}

void draw_outline(Out out, const Frame& f, const Shape& shape, const geometry::Pose2& pose, const std::string& style) {
  if (shape.is_disc()) {
    fmt::format_to(out, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", f.x(pose.x), f.y(pose.y),
                   shape.radius_m * f.px_per_m, style);
  } else {
    fmt::format_to(out, "<path d=\"{}\" {}/>\n", outline_path(f, shape, pose), style);
  }
}

/// One dot for each place, however often somebody walked there: dashes that overlap would look like a line.
void draw_steps(Out out, const Frame& f, const BodyTrace& body) {
  std::set<std::pair<long, long>> visited;
  const double step_m = 6.0 / f.px_per_m;
  std::string dots;
  Point2 last{1e18, 1e18};
  for (const auto& [t_s, pose] : body.way) {
    if (geometry::distance(pose.position(), last) < step_m) continue;
    last = pose.position();
    if (!visited.emplace(std::lround(last.x / step_m), std::lround(last.y / step_m)).second) continue;
    dots += fmt::format("M{:.1f} {:.1f}h0", f.x(last.x), f.y(last.y));
  }
  fmt::format_to(
      out, "<path d=\"{}\" fill=\"none\" stroke=\"#9b7fc0\" stroke-width=\"2.6\" stroke-linecap=\"round\"/>\n", dots);
}

void draw_bodies(Out out, const Frame& f, const RunReport& report) {
  for (const auto& [id, body] : report.bodies) {
    if (body.way.empty()) continue;
    if (body.kind == BodyKind::kBlock) {
      draw_outline(out, f, body.shape, body.way.back().second,
                   "fill=\"#8d6e63\" stroke=\"#4e342e\" stroke-width=\"1.5\"");
      continue;
    }
    draw_steps(out, f, body);
    draw_outline(out, f, body.shape, body.way.back().second,
                 "fill=\"#9b7fc0\" fill-opacity=\"0.45\" stroke=\"#6b46a3\"");
  }
}

void draw_plans(Out out, const Frame& f, const VehicleRow& vehicle, const char* colour) {
  for (const PlanTrace& plan : vehicle.plans) {
    fmt::format_to(out,
                   "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1\" stroke-opacity=\"0.75\" "
                   "stroke-dasharray=\"6 3\"/>\n",
                   path_of(f, plan.waypoints_in_map), colour);
  }
}

/// Where it jumped (set down anew after a restart of the simulation) the line is cut.
void draw_way(Out out, const Frame& f, const VehicleRow& vehicle, const char* colour) {
  std::vector<Point2> piece;
  const auto flush = [&] {
    if (piece.size() > 1) {
      fmt::format_to(out,
                     "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"3.6\" stroke-opacity=\"0.8\" "
                     "stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n",
                     path_of(f, piece), colour);
    }
    piece.clear();
  };
  for (const DrivePoint& point : vehicle.drive.trace()) {
    if (!piece.empty() && geometry::distance(piece.back(), point.base_in_map.position()) > 1.0) flush();
    piece.push_back(point.base_in_map.position());
  }
  flush();
}

void draw_vehicle(Out out, const Frame& f, const VehicleRow& vehicle, const geometry::Pose2& pose, const char* colour,
                  double opacity) {
  draw_outline(
      out, f, vehicle.shape, middle_in_map(pose, vehicle.ahead_m),
      fmt::format("fill=\"{0}\" fill-opacity=\"{1}\" stroke=\"{0}\" stroke-opacity=\"{2}\" stroke-width=\"1.1\"",
                  colour, opacity, std::min(1.0, opacity + 0.45)));
  const double nose_m =
      vehicle.ahead_m + (vehicle.shape.is_disc() ? vehicle.shape.radius_m : 0.5 * vehicle.shape.length_m);
  const Point2 nose = geometry::to_map(pose, {nose_m, 0.0});
  fmt::format_to(out, "<path d=\"{}\" stroke=\"{}\" stroke-width=\"1.4\" stroke-opacity=\"{}\"/>\n",
                 path_of(f, {pose.position(), nose}), colour, std::min(1.0, opacity + 0.45));
}

void draw_vehicles(Out out, const Frame& f, const VehicleRow& vehicle, const char* colour) {
  const std::vector<DrivePoint>& trace = vehicle.drive.trace();
  if (trace.empty()) return;
  double next_s = trace.front().t_s;
  Point2 last{1e18, 1e18};
  for (const DrivePoint& point : trace) {
    if (point.t_s < next_s || geometry::distance(point.base_in_map.position(), last) < vehicle.shape.reach_m())
      continue;
    draw_vehicle(out, f, vehicle, point.base_in_map, colour, 0.10);
    next_s = point.t_s + kOutlineEvery_s;
    last = point.base_in_map.position();
  }
  const geometry::Pose2& end = vehicle.drive.base_in_map();
  draw_vehicle(out, f, vehicle, end, colour, 0.85);
  const double down_px = vehicle.shape.reach_m() * f.px_per_m + 14.0;  // goals' flags stand above
  fmt::format_to(out,
                 "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"middle\" font-size=\"13\" font-weight=\"bold\" "
                 "fill=\"{2}\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\">{3}</text>\n",
                 f.x(end.x), f.y(end.y) + down_px, colour, escaped(vehicle.agv_id));
}

void draw_goals(Out out, const Frame& f, const std::vector<GoalRecord>& goals, const std::string& agv_id,
                const char* colour) {
  std::vector<std::pair<Point2, std::string>> labels;  // a place that is visited twice is drawn once: "1, 4"
  int number = 0;
  for (const GoalRecord& goal : goals) {
    if (goal.agv_id != agv_id) continue;
    const Point2 at = goal.pose_in_map.position();
    const std::string text = std::to_string(++number) + (goal.outcome == GoalOutcome::kReached ? "" : "!");
    const auto same = std::find_if(labels.begin(), labels.end(),
                                   [&](const auto& l) { return geometry::distance(l.first, at) < 0.2; });
    if (same == labels.end()) {
      labels.emplace_back(at, text);
    } else {
      same->second += " " + text;
    }
  }
  for (const auto& [at, text] : labels) {
    const bool missed = text.find('!') != std::string::npos;
    const double width_px = 10.0 + 7.0 * static_cast<double>(text.size());
    fmt::format_to(out,
                   "<path d=\"M{0:.1f} {1:.1f}v-19\" stroke=\"{2}\" stroke-width=\"2\"/><circle cx=\"{0:.1f}\" "
                   "cy=\"{1:.1f}\" r=\"3\" fill=\"{2}\"/>"
                   "<rect x=\"{0:.1f}\" y=\"{3:.1f}\" width=\"{4:.1f}\" height=\"15\" rx=\"2\" fill=\"{5}\" "
                   "stroke=\"{2}\" stroke-width=\"1.5\"/>"
                   "<text x=\"{6:.1f}\" y=\"{7:.1f}\" font-size=\"11\" font-weight=\"bold\" text-anchor=\"middle\" "
                   "fill=\"{8}\">{9}</text>\n",
                   f.x(at.x), f.y(at.y), colour, f.y(at.y) - 33.0, width_px, missed ? "#ffffff" : colour,
                   f.x(at.x) + 0.5 * width_px, f.y(at.y) - 21.5, missed ? kAlarm : "#ffffff", text);
  }
}

void draw_contacts(Out out, const Frame& f, const std::vector<Contact>& contacts) {
  for (const Contact& contact : contacts) {
    const double x = f.x(contact.at_in_map.x);
    const double y = f.y(contact.at_in_map.y);
    fmt::format_to(
        out,
        "<g stroke=\"{0}\" stroke-width=\"3.5\" fill=\"none\"><circle cx=\"{1:.1f}\" cy=\"{2:.1f}\" r=\"13\"/>"
        "<path d=\"M{3:.1f} {4:.1f}l10 10m0 -10l-10 10\"/><title>{5} and {6} at {7:.2f} s</title></g>\n",
        kAlarm, x, y, x - 5.0, y - 5.0, escaped(contact.a), escaped(contact.b), contact.begin_s);
  }
}

struct Tile {
  std::string name;
  std::string value;
  bool alarm{false};
};

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

void draw_header(Out out, const RunReport& report) {
  fmt::format_to(out, "<text x=\"{}\" y=\"38\" font-size=\"23\" font-weight=\"bold\" fill=\"{}\">{}</text>\n",
                 kMargin_px, kInk, escaped(report.scenario));
  fmt::format_to(out,
                 "<text x=\"{}\" y=\"38\" font-size=\"14\" text-anchor=\"end\" fill=\"{}\">{} vehicles, seed {} "
                 "\xC2\xB7 <tspan font-weight=\"bold\" fill=\"{}\">{}</tspan></text>\n",
                 kWidth_px - kMargin_px, kFaint, report.vehicles.size(), report.seed,
                 report.passed() ? "#2f855a" : kAlarm, report.passed() ? "passed" : "failed");
  const std::vector<Tile> tiles = tiles_of(report);
  const double step_px = (kWidth_px - 2.0 * kMargin_px) / static_cast<double>(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const double x = kMargin_px + step_px * static_cast<double>(i);
    fmt::format_to(out,
                   "<text x=\"{0:.1f}\" y=\"78\" font-size=\"20\" font-weight=\"bold\" fill=\"{1}\">{2}</text><text "
                   "x=\"{0:.1f}\" y=\"97\" font-size=\"11.5\" fill=\"{3}\">{4}</text>\n",
                   x, tiles[i].alarm ? kAlarm : kInk, tiles[i].value, kFaint, tiles[i].name);
  }
}

void draw_scale(Out out, const Frame& f) {
  double length_m = 1.0;
  for (const double candidate_m : {2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (candidate_m * f.px_per_m <= 170.0) length_m = candidate_m;
  }
  const double y = f.top_px + f.height_px() + 22.0;
  const double right = kWidth_px - kMargin_px;
  fmt::format_to(out,
                 "<path d=\"M{0:.1f} {1:.1f}v6h{2:.1f}v-6\" fill=\"none\" stroke=\"{3}\" stroke-width=\"1.5\"/><text "
                 "x=\"{4:.1f}\" y=\"{5:.1f}\" font-size=\"12\" text-anchor=\"middle\" fill=\"{3}\">{6:.0f} m</text>\n",
                 right - length_m * f.px_per_m, y - 4.0, length_m * f.px_per_m, kFaint,
                 right - 0.5 * length_m * f.px_per_m, y + 18.0, length_m);
}

/// Symbols in one line, vehicles in rows below. Returns the picture's height.
double draw_legend(Out out, const Frame& f, const RunReport& report) {
  double y = f.top_px + f.height_px() + 24.0;
  double x = kMargin_px;
  const auto entry = [&](const std::string& symbol, const char* text, double width_px) {
    fmt::format_to(out,
                   "<g transform=\"translate({:.1f} {:.1f})\">{}<text x=\"36\" y=\"4\" font-size=\"12.5\" "
                   "fill=\"{}\">{}</text></g>\n",
                   x, y, symbol, kInk, text);
    x += width_px;
  };
  entry("<path d=\"M0 0h28\" stroke=\"#52606d\" stroke-width=\"3.6\" stroke-linecap=\"round\"/>", "driven", 98);
  entry("<path d=\"M0 0h28\" stroke=\"#52606d\" stroke-width=\"1\" stroke-dasharray=\"6 3\"/>", "planned", 106);
  entry(
      "<circle cx=\"14\" r=\"8\" fill=\"#52606d\" fill-opacity=\"0.12\" stroke=\"#52606d\"/><path d=\"M14 0h8\" "
      "stroke=\"#52606d\"/>",
      "vehicle every 3 s", 166);
  entry(
      "<path d=\"M2 0h26\" stroke=\"#9b7fc0\" stroke-width=\"2.4\" stroke-linecap=\"round\" stroke-dasharray=\"0.1 "
      "5\"/>",
      "person", 100);
  entry("<rect x=\"6\" y=\"-8\" width=\"16\" height=\"16\" fill=\"#8d6e63\" stroke=\"#4e342e\"/>", "hidden block", 134);
  entry("<rect x=\"2\" y=\"-8\" width=\"26\" height=\"16\" fill=\"url(#blocked)\" stroke=\"#b7791f\"/>",
        "blocked in the map", 176);
  entry(
      "<path d=\"M8 9v-17\" stroke=\"#52606d\" stroke-width=\"2\"/><rect x=\"8\" y=\"-9\" width=\"15\" height=\"10\" "
      "fill=\"#52606d\"/>",
      "goal", 84);
  entry(fmt::format("<circle cx=\"14\" r=\"8\" fill=\"none\" stroke=\"{0}\" stroke-width=\"3\"/><path d=\"M11 -3l6 6m0 "
                    "-6l-6 6\" stroke=\"{0}\" stroke-width=\"2\"/>",
                    kAlarm),
        "contact", 100);
  y += 30.0;
  x = kMargin_px;
  std::size_t index = 0;
  for (const auto& [id, vehicle] : report.vehicles) {
    if (x > kWidth_px - kMargin_px - 260.0) {
      x = kMargin_px;
      y += 22.0;
    }
    fmt::format_to(out,
                   "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"14\" rx=\"3\" fill=\"{}\"/><text "
                   "x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12.5\" fill=\"{}\"><tspan font-weight=\"bold\">{}</tspan> "
                   "{:.0f} m, {} stops, {} replans</text>\n",
                   x, y - 11.0, vehicle_colour(index++), x + 20.0, y, kInk, escaped(id), vehicle.drive.distance_m(),
                   vehicle.drive.stops(), vehicle.replans);
    x += 268.0;
  }
  return y + 22.0;
}

constexpr const char* kPatterns =
    "<defs><pattern id=\"blocked\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" "
    "patternTransform=\"rotate(45)\">"
    "<rect width=\"8\" height=\"8\" fill=\"#fdf3dc\"/><rect width=\"3\" height=\"8\" fill=\"#e0a030\"/></pattern>"
    "<pattern id=\"freed\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">"
    "<rect width=\"8\" height=\"8\" fill=\"#e6f4ea\"/><rect width=\"2\" height=\"8\" "
    "fill=\"#68b684\"/></pattern></defs>\n";

}  // namespace

std::string fleet_svg(const RunReport& report, const Walls& walls) {
  const Frame frame = frame_of(area_of(report, walls));
  std::string body;
  const Out out = std::back_inserter(body);
  fmt::format_to(out,
                 "<clipPath id=\"shown\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                 "height=\"{:.1f}\"/></clipPath><g clip-path=\"url(#shown)\">\n",
                 frame.left_px, frame.top_px, frame.width_px(), frame.height_px());
  draw_walls(out, frame, walls);
  draw_edits(out, frame, report.edits);
  draw_bodies(out, frame, report);
  std::size_t index = 0;
  for (const auto& [id, vehicle] : report.vehicles) draw_plans(out, frame, vehicle, vehicle_colour(index++));
  index = 0;
  for (const auto& [id, vehicle] : report.vehicles) draw_way(out, frame, vehicle, vehicle_colour(index++));
  index = 0;
  for (const auto& [id, vehicle] : report.vehicles) draw_vehicles(out, frame, vehicle, vehicle_colour(index++));
  index = 0;
  for (const auto& [id, vehicle] : report.vehicles) draw_goals(out, frame, report.goals, id, vehicle_colour(index++));
  draw_contacts(out, frame, report.contacts);
  body += "</g>\n";
  draw_header(out, report);
  draw_scale(out, frame);
  const double height_px = draw_legend(out, frame, report);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "{2}>\n{3}<rect width=\"100%\" height=\"100%\" fill=\"#f5f7fa\"/>\n{4}</svg>\n",
      kWidth_px, height_px, kFont, kPatterns, body);
}

}  // namespace aisle::referee
