#include "tools/referee/report/speeds_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/referee/report/picture.hpp"

namespace aisle::referee {
namespace {

using Out = std::back_insert_iterator<std::string>;

constexpr double kWidth_px = 1400.0;
constexpr double kLeft_px = 92.0;
constexpr double kRight_px = 28.0;
constexpr double kTop_px = 84.0;
constexpr double kStrip_px = 112.0;
constexpr double kBetween_px = 22.0;

/// The axes of one vehicle's strip.
struct Strip {
  double top_px;
  double duration_s;
  double highest_mps;
  double x(double t_s) const {
    return kLeft_px + std::clamp(t_s / duration_s, 0.0, 1.0) * (kWidth_px - kLeft_px - kRight_px);
  }
  double y(double speed_mps) const { return top_px + kStrip_px * (1.0 - std::min(1.0, speed_mps / highest_mps)); }
};

double round_step(double span, int wanted) {
  const double raw = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * power) return factor * power;
  }
  return 10.0 * power;
}

void draw_axes(Out out, const Strip& s) {
  fmt::format_to(
      out, "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#ffffff\" stroke=\"#cbd2d9\"/>\n",
      kLeft_px, s.top_px, kWidth_px - kLeft_px - kRight_px, kStrip_px);
  for (double speed = 0.0; speed <= s.highest_mps + 1e-9; speed += 0.5) {
    fmt::format_to(out,
                   "<path d=\"M{0} {1:.1f}H{2}\" stroke=\"#e4e7eb\"/><text x=\"{3}\" y=\"{4:.1f}\" font-size=\"11\" "
                   "text-anchor=\"end\" fill=\"{5}\">{6:.1f}</text>\n",
                   kLeft_px, s.y(speed), kWidth_px - kRight_px, kLeft_px - 6.0, s.y(speed) + 4.0, kFaint, speed);
  }
}

void draw_standing(Out out, const Strip& s, const std::vector<DrivePoint>& trace) {
  for (std::size_t i = 0; i < trace.size();) {
    std::size_t end = i + 1;
    while (end < trace.size() && trace[end].standing == trace[i].standing) ++end;
    if (trace[i].standing != Standing::kNone) {
      const double until_s = end < trace.size() ? trace[end].t_s : trace.back().t_s;
      fmt::format_to(
          out,
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" fill-opacity=\"0.28\"/>\n",
          s.x(trace[i].t_s), s.top_px, std::max(1.0, s.x(until_s) - s.x(trace[i].t_s)), kStrip_px,
          trace[i].standing == Standing::kHolds ? kAlarm : "#f0b429");
    }
    i = end;
  }
}

void draw_speed(Out out, const Strip& s, const std::vector<DrivePoint>& trace, const char* colour) {
  if (trace.empty()) return;
  std::string line;
  for (const DrivePoint& p : trace)
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", s.x(p.t_s), s.y(p.speed_mps));
  fmt::format_to(out, "<path d=\"{}L{:.1f} {:.1f}L{:.1f} {:.1f}z\" fill=\"{}\" fill-opacity=\"0.14\"/>\n", line,
                 s.x(trace.back().t_s), s.y(0.0), s.x(trace.front().t_s), s.y(0.0), colour);
  fmt::format_to(out, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.7\" stroke-linejoin=\"round\"/>\n",
                 line, colour);
}

void draw_marks(Out out, const Strip& s, const RunReport& report, const std::string& agv_id, const char* colour) {
  for (const EditRow& edit : report.edits) {
    fmt::format_to(
        out,
        "<path d=\"M{0:.1f} {1:.1f}v{2:.1f}\" stroke=\"#b7791f\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"/>\n",
        s.x(edit.asked_s), s.top_px, kStrip_px);
  }
  for (const GoalRecord& goal : report.goals) {
    if (goal.agv_id != agv_id || goal.outcome != GoalOutcome::kReached) continue;
    fmt::format_to(out,
                   "<path d=\"M{0:.1f} {1:.1f}v-17\" stroke=\"{2}\" stroke-width=\"1.5\"/><path d=\"M{0:.1f} "
                   "{3:.1f}l11 4l-11 4z\" fill=\"{2}\"/>\n",
                   s.x(goal.decided_s), s.top_px + kStrip_px, colour, s.top_px + kStrip_px - 18.0);
  }
  for (const Contact& contact : report.contacts) {
    if (contact.a != agv_id && contact.b != agv_id) continue;
    fmt::format_to(out, "<path d=\"M{:.1f} {:.1f}v{:.1f}\" stroke=\"{}\" stroke-width=\"3\"/>\n", s.x(contact.begin_s),
                   s.top_px, kStrip_px, kAlarm);
  }
}

void draw_time_axis(Out out, const Strip& s) {
  const double step_s = round_step(s.duration_s, 12);
  for (double t = 0.0; t <= s.duration_s + 1e-9; t += step_s) {
    fmt::format_to(out,
                   "<path d=\"M{0:.1f} {1:.1f}v5\" stroke=\"{2}\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
                   "font-size=\"11.5\" text-anchor=\"middle\" fill=\"{2}\">{4:g} s</text>\n",
                   s.x(t), s.top_px + kStrip_px, kFaint, s.top_px + kStrip_px + 19.0, t);
  }
}

void draw_header(Out out, const RunReport& report) {
  fmt::format_to(out,
                 "<text x=\"28\" y=\"36\" font-size=\"21\" font-weight=\"bold\" fill=\"{}\">{}: speeds</text><text "
                 "x=\"28\" y=\"58\" font-size=\"12.5\" fill=\"{}\">metres per second, from ground truth</text>\n",
                 kInk, escaped(report.scenario), kFaint);
  double x = kWidth_px - 640.0;
  const auto entry = [&](const std::string& symbol, const char* text, double width_px) {
    fmt::format_to(
        out,
        "<g transform=\"translate({:.1f} 36)\">{}<text x=\"28\" y=\"4\" font-size=\"12.5\" fill=\"{}\">{}</text></g>\n",
        x, symbol, kInk, text);
    x += width_px;
  };
  entry("<rect y=\"-8\" width=\"22\" height=\"16\" fill=\"#f0b429\" fill-opacity=\"0.28\"/>", "waits", 88);
  entry(fmt::format("<rect y=\"-8\" width=\"22\" height=\"16\" fill=\"{}\" fill-opacity=\"0.28\"/>", kAlarm), "holds",
        88);
  entry(
      "<path d=\"M6 9v-17\" stroke=\"#52606d\" stroke-width=\"1.5\"/><path d=\"M6 -9l11 4l-11 4z\" fill=\"#52606d\"/>",
      "goal reached", 134);
  entry("<path d=\"M11 -9v18\" stroke=\"#b7791f\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"/>", "map edit", 108);
  entry(fmt::format("<path d=\"M11 -9v18\" stroke=\"{}\" stroke-width=\"3\"/>", kAlarm), "contact", 100);
}

}  // namespace

std::string speeds_svg(const RunReport& report) {
  std::string body;
  const Out out = std::back_inserter(body);
  double highest_mps = 0.5;
  for (const auto& [id, vehicle] : report.vehicles)
    highest_mps = std::max(highest_mps, 0.5 * std::ceil(vehicle.drive.max_speed_mps() / 0.5));
  Strip strip{kTop_px, std::max(1.0, report.duration_s), highest_mps};
  draw_header(out, report);
  std::size_t index = 0;
  for (const auto& [id, vehicle] : report.vehicles) {
    const char* colour = vehicle_colour(index);
    strip.top_px = kTop_px + static_cast<double>(index++) * (kStrip_px + kBetween_px);
    draw_axes(out, strip);
    draw_standing(out, strip, vehicle.drive.trace());
    draw_speed(out, strip, vehicle.drive.trace(), colour);
    draw_marks(out, strip, report, id, colour);
    fmt::format_to(out,
                   "<text transform=\"translate(30 {:.1f}) rotate(-90)\" font-size=\"13\" font-weight=\"bold\" "
                   "text-anchor=\"middle\" fill=\"{}\">{}</text>\n",
                   strip.top_px + 0.5 * kStrip_px, colour, escaped(id));
  }
  draw_time_axis(out, strip);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "{2}>\n<rect width=\"100%\" height=\"100%\" fill=\"#f5f7fa\"/>\n{3}</svg>\n",
      kWidth_px, strip.top_px + kStrip_px + 40.0, kFont, body);
}

}  // namespace aisle::referee
