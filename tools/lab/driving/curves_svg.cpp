#include "tools/lab/driving/curves_svg.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/draw/chart.hpp"
#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/svg.hpp"

namespace aisle::lab {
namespace {

constexpr int kWidthPx = 900;
constexpr int kLeftPx = 60;
constexpr int kRightPx = 20;
constexpr int kChartPx = 170;
constexpr int kTopPx = 70;
constexpr int kBetweenPx = 40;
constexpr int kKeyPx = 280;  // from one curve's name to the next
constexpr const char* kZeroLine = "#9aa5b1";

/// The box with lines at round values.
std::string axes(const draw::Chart& chart, const std::string& label) {
  std::string svg = draw::chart_box(chart) + "\n" + draw::text(kLeftPx, chart.top_px - 6, "", label) + "\n";
  const double step = draw::round_step(chart.high - chart.low, 6);

  for (int i = static_cast<int>(std::ceil(chart.low / step - 1e-9)); i * step <= chart.high + 1e-9; ++i)
    svg += draw::value_line(chart, i * step, i == 0 ? kZeroLine : draw::kGridLine, "text-anchor=\"end\"") + "\n";

  return svg;
}

using Samples = std::vector<draw::Sample>;

/// One member of the points over time.
Samples samples_of(const std::vector<DrivePoint>& points, double DrivePoint::*of) {
  Samples samples;
  for (const DrivePoint& p : points) samples.push_back({p.t_s, p.*of});
  return samples;
}

/// The heading over time, without jumps at half a turn.
Samples attitude_of(const std::vector<DrivePoint>& points) {
  Samples samples;
  for (const DrivePoint& p : points) {
    const double yaw = p.base_in_map.yaw;
    const double before = samples.empty() ? yaw : samples.back().value;
    samples.push_back({p.t_s, before + geometry::wrap(yaw - before)});
  }
  return samples;
}

/// The least and the greatest value of all, at least a radian apart.
std::pair<double, double> range_of(const std::vector<Samples>& all) {
  double low = 0.0, high = 1.0;
  for (const Samples& samples : all)
    for (const draw::Sample& sample : samples) low = std::min(low, sample.value), high = std::max(high, sample.value);
  return {low, high};
}

std::string curve(const draw::Chart& chart, const Samples& samples, const char* colour) {
  return draw::path(draw::curve(chart, samples),
                    std::string("fill=\"none\" stroke=\"") + colour +
                        "\" stroke-width=\"1.5\" stroke-linejoin=\"round\" opacity=\"0.85\"") +
         "\n";
}

/// Round seconds below the lowest chart.
std::string time_axis(const draw::Chart& chart) {
  std::string svg;
  const double step_s = draw::round_step(chart.duration_s, 8);

  for (int i = 0; i * step_s <= chart.duration_s; ++i)
    svg += draw::text(static_cast<int>(std::lround(chart.x(i * step_s))), chart.bottom_px() + 18,
                      "text-anchor=\"middle\"", std::to_string(std::lround(i * step_s))) +
           "\n";

  return svg +
         draw::text((kLeftPx + chart.right_px()) / 2, chart.bottom_px() + 36, "text-anchor=\"middle\"", "time, s") +
         "\n";
}

}  // namespace

/// The charts share the time axis; their scales hold all drives.
std::string curves_svg(const std::string& title, const std::vector<NamedDrive>& drives) {
  double duration_s = 1.0, v = 0.1, w = 0.1;
  std::vector<Samples> attitudes;
  for (const NamedDrive& drive : drives) {
    attitudes.push_back(attitude_of(drive.figures->points));
    for (const DrivePoint& p : drive.figures->points)
      duration_s = std::max(duration_s, p.t_s), v = std::max(v, p.linear_mps),
      w = std::max(w, std::abs(p.angular_radps));
  }

  const int width_px = kWidthPx - kLeftPx - kRightPx;
  const auto [low, high] = range_of(attitudes);
  const draw::Chart speed{kLeftPx, kTopPx, width_px, kChartPx, duration_s, 0.0, v};
  const draw::Chart turn{kLeftPx, speed.bottom_px() + kBetweenPx, width_px, kChartPx, duration_s, -w, w};
  const draw::Chart attitude{kLeftPx, turn.bottom_px() + kBetweenPx, width_px, kChartPx, duration_s, low, high};

  std::string body = draw::text(kLeftPx, 22, "font-size=\"15\" font-weight=\"bold\"", title) + "\n" +
                     axes(speed, "speed, m/s") + axes(turn, "turn rate, rad/s") +
                     axes(attitude, "attitude (heading in the map), rad");
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const char* colour = draw::colour(i);
    const std::vector<DrivePoint>& points = drives[i].figures->points;
    body += curve(speed, samples_of(points, &DrivePoint::linear_mps), colour);
    body += curve(turn, samples_of(points, &DrivePoint::angular_radps), colour);
    body += curve(attitude, attitudes[i], colour);
    body += draw::curve_key(kLeftPx + kKeyPx * static_cast<int>(i), 40, colour, drives[i].name);
  }

  body += time_axis(attitude);
  return draw::document({kWidthPx, attitude.bottom_px() + 46, std::string(draw::kSansSerif) + " font-size=\"12\""},
                        body);
}

}  // namespace aisle::lab
