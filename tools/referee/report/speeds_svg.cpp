#include "tools/referee/report/speeds_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/draw/chart.hpp"
#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/svg.hpp"
#include "tools/referee/report/style.hpp"

namespace aisle::referee {
namespace {

using draw::Chart;

constexpr int kWidthPx = 1400;
constexpr int kLeftPx = 92;
constexpr int kRightPx = 28;
constexpr int kTopPx = 84;
constexpr int kChartPx = 112;
constexpr int kBetweenPx = 22;
constexpr int kLegendPx = 640;  // from the right
constexpr double kSpeedStepMps = 0.5;
constexpr const char* kWaits = "#f0b429";

/// The box with a line for each step of speed.
std::string axes(const Chart& chart) {
  std::string svg = draw::chart_box(chart) + "\n";
  const std::string attributes = fmt::format("font-size=\"11\" text-anchor=\"end\" fill=\"{}\"", draw::kFaint);

  for (double mps = 0.0; mps <= chart.high + 1e-9; mps += kSpeedStepMps)
    svg += draw::value_line(chart, mps, draw::kGridLine, attributes) + "\n";

  return svg;
}

/// Coloured where the vehicle stands because it waits or holds.
std::string standing(const Chart& chart, const std::vector<DrivePoint>& trace) {
  std::string svg;
  for (std::size_t i = 0; i < trace.size();) {
    std::size_t end = i + 1;
    while (end < trace.size() && trace[end].standing == trace[i].standing) ++end;

    if (trace[i].standing != Standing::kNone) {
      const double from_px = chart.x(trace[i].t_s);
      const double to_px = chart.x(end < trace.size() ? trace[end].t_s : trace.back().t_s);

      svg += draw::rect(from_px, double(chart.top_px), std::max(1.0, to_px - from_px), double(chart.height_px),
                        fmt::format("fill=\"{}\" fill-opacity=\"0.28\"",
                                    trace[i].standing == Standing::kHolds ? draw::kAlarm : kWaits)) +
             "\n";
    }

    i = end;
  }

  return svg;
}

/// The curve, and its area down to zero.
std::string speed(const Chart& chart, const std::vector<DrivePoint>& trace, const char* colour) {
  if (trace.empty()) return "";

  std::vector<draw::Sample> samples;
  for (const DrivePoint& p : trace) samples.push_back({p.t_s, p.speed_mps});

  const std::string line = draw::curve(chart, samples);
  samples.push_back({trace.back().t_s, 0.0});
  samples.push_back({trace.front().t_s, 0.0});

  return draw::path(draw::curve(chart, samples) + "z", fmt::format("fill=\"{}\" fill-opacity=\"0.14\"", colour)) +
         "\n" +
         draw::path(line,
                    fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.7\" stroke-linejoin=\"round\"", colour)) +
         "\n";
}

/// A line from top to bottom at a moment.
std::string mark(const Chart& chart, double t_s, const std::string& attributes) {
  return draw::path(fmt::format("M{:.1f} {}.0v{}.0", chart.x(t_s), chart.top_px, chart.height_px), attributes) + "\n";
}

/// Map edits on every strip; goals and contacts on those of their vehicles.
std::string marks(const Chart& chart, const RunReport& report, const std::string& agv_id, const char* colour) {
  std::string svg;
  for (const EditRow& edit : report.edits)
    svg +=
        mark(chart, edit.asked_s, fmt::format("stroke=\"{}\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"", kBlocked));

  for (const GoalRecord& goal : report.goals) {
    if (goal.agv_id != agv_id || goal.outcome != GoalOutcome::kReached) continue;

    const double x = chart.x(goal.decided_s);
    svg += draw::path(fmt::format("M{:.1f} {}.0v-17", x, chart.bottom_px()),
                      fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", colour)) +
           draw::path(fmt::format("M{:.1f} {}.0l11 4l-11 4z", x, chart.bottom_px() - 18),
                      fmt::format("fill=\"{}\"", colour)) +
           "\n";
  }

  for (const Contact& contact : report.contacts) {
    if (contact.a != agv_id && contact.b != agv_id) continue;
    svg += mark(chart, contact.begin_s, fmt::format("stroke=\"{}\" stroke-width=\"3\"", draw::kAlarm));
  }

  return svg;
}

/// Round steps of time below the last strip.
std::string time_axis(const Chart& chart) {
  const double step_s = draw::round_step(chart.duration_s, 12);
  std::string svg;

  for (double t_s = 0.0; t_s <= chart.duration_s + 1e-9; t_s += step_s)
    svg += draw::path(fmt::format("M{:.1f} {}.0v5", chart.x(t_s), chart.bottom_px()),
                      fmt::format("stroke=\"{}\"", draw::kFaint)) +
           draw::text(chart.x(t_s), chart.bottom_px() + 19.0,
                      fmt::format("font-size=\"11.5\" text-anchor=\"middle\" fill=\"{}\"", draw::kFaint),
                      fmt::format("{:g} s", t_s)) +
           "\n";

  return svg;
}

std::string header(const RunReport& report) {
  return draw::text(28, 36, fmt::format("font-size=\"21\" font-weight=\"bold\" fill=\"{}\"", draw::kInk),
                    report.scenario + ": speeds") +
         draw::text(28, 58, fmt::format("font-size=\"12.5\" fill=\"{}\"", draw::kFaint),
                    "metres per second, from ground truth") +
         "\n";
}

/// What colours and marks mean.
std::string signs() {
  draw::Legend legend(double(kWidthPx - kLegendPx), 36, 28, fmt::format("font-size=\"12.5\" fill=\"{}\"", draw::kInk));
  const auto shade = [](const char* colour) {
    return fmt::format("<rect y=\"-8\" width=\"22\" height=\"16\" fill=\"{}\" fill-opacity=\"0.28\"/>", colour);
  };

  legend.add(shade(kWaits), "waits", 88);
  legend.add(shade(draw::kAlarm), "holds", 88);
  legend.add(
      "<path d=\"M6 9v-17\" stroke=\"#52606d\" stroke-width=\"1.5\"/><path d=\"M6 -9l11 4l-11 4z\" fill=\"#52606d\"/>",
      "goal reached", 134);
  legend.add(
      fmt::format("<path d=\"M11 -9v18\" stroke=\"{}\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"/>", kBlocked),
      "map edit", 108);
  legend.add(fmt::format("<path d=\"M11 -9v18\" stroke=\"{}\" stroke-width=\"3\"/>", draw::kAlarm), "contact", 100);

  return legend.svg();
}

}  // namespace

/// A strip for each vehicle, all with the scale of the fastest.
std::string speeds_svg(const RunReport& report) {
  double highest_mps = kSpeedStepMps;
  for (const auto& [id, vehicle] : report.vehicles)
    highest_mps = std::max(highest_mps, kSpeedStepMps * std::ceil(vehicle.drive.max_speed_mps() / kSpeedStepMps));

  // One strip below the other, all with the same scale.
  Chart chart{kLeftPx, kTopPx,     kWidthPx - kLeftPx - kRightPx, kChartPx, std::max(1.0, report.duration_s),
              0.0,     highest_mps};

  std::string body = header(report) + signs();
  std::size_t index = 0;

  for (const auto& [id, vehicle] : report.vehicles) {
    const char* colour = draw::colour(index, kVehicleColours);
    chart.top_px = kTopPx + static_cast<int>(index++) * (kChartPx + kBetweenPx);
    body += axes(chart) + standing(chart, vehicle.drive.trace()) + speed(chart, vehicle.drive.trace(), colour) +
            marks(chart, report, id, colour);
    body += fmt::format(
        "<text transform=\"translate(30 {:.1f}) rotate(-90)\" font-size=\"13\" font-weight=\"bold\" "
        "text-anchor=\"middle\" fill=\"{}\">{}</text>\n",
        chart.top_px + 0.5 * kChartPx, colour, draw::escaped(id));
  }

  body += time_axis(chart);
  return draw::document({kWidthPx, chart.bottom_px() + 40, kFont}, body);
}

}  // namespace aisle::referee
