#include "tools/lab/driving/curves_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace aisle::cli {
namespace {

constexpr std::array<const char*, 4> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
constexpr double kWidthPx = 900.0;
constexpr double kLeftPx = 60.0;
constexpr double kStripPx = 170.0;
constexpr double kTopPx = 50.0;

/// 1, 2 or 5 times a power of ten, so that there are at most `most` of them in `span`.
double step_of(double span, int most) {
  const double power = std::pow(10.0, std::floor(std::log10(span / most)));
  for (const double times : {1.0, 2.0, 5.0})
    if (span / (times * power) <= most) return times * power;
  return 10.0 * power;
}

/// Axes of one strip; values from `low` to `high`.
struct Strip {
  double top_px, duration_s, low, high;
  double x(double t_s) const { return kLeftPx + t_s / duration_s * (kWidthPx - kLeftPx - 20.0); }
  double y(double value) const { return top_px + kStripPx * (high - value) / (high - low); }
};

std::string axes(const Strip& s, const std::string& label) {
  std::string text = fmt::format(
      "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#ffffff\" stroke=\"#cbd2d9\"/>\n<text "
      "x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
      kLeftPx, s.top_px, kWidthPx - kLeftPx - 20.0, kStripPx, kLeftPx, s.top_px - 6.0, label);
  const double step = step_of(s.high - s.low, 6);
  for (int i = static_cast<int>(std::ceil(s.low / step - 1e-9)); i * step <= s.high + 1e-9; ++i)
    text += fmt::format(
        "<path d=\"M{0:.0f} {1:.1f}H{2:.0f}\" stroke=\"{6}\"/><text x=\"{3:.0f}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:.1f}</text>\n",
        kLeftPx, s.y(i * step), kWidthPx - 20.0, kLeftPx - 6.0, s.y(i * step) + 4.0, i * step,
        i == 0 ? "#9aa5b1" : "#e4e7eb");
  return text;
}

std::string line(const Strip& s, const std::vector<DrivePoint>& points, double DrivePoint::*of, const char* colour) {
  std::string path;
  for (const DrivePoint& p : points)
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", s.x(p.t_s), s.y(p.*of));
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" stroke-linejoin=\"round\" opacity=\"0.85\"/>\n",
      path, colour);
}

}  // namespace

std::string curves_svg(const std::string& title, const std::vector<NamedDrive>& drives) {
  double duration_s = 1.0, v = 0.1, w = 0.1;
  for (const NamedDrive& drive : drives)
    for (const DrivePoint& p : drive.figures->points)
      duration_s = std::max(duration_s, p.t_s), v = std::max(v, p.linear_mps),
      w = std::max(w, std::abs(p.angular_radps));
  const Strip speed{kTopPx + 20.0, duration_s, 0.0, v};
  const Strip turn{kTopPx + kStripPx + 60.0, duration_s, -w, w};
  std::string body = axes(speed, "speed, m/s") + axes(turn, "turn rate, rad/s");
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    body += line(speed, drives[i].figures->points, &DrivePoint::linear_mps, colour);
    body += line(turn, drives[i].figures->points, &DrivePoint::angular_radps, colour);
    const double x = kLeftPx + 280.0 * static_cast<double>(i);
    body += fmt::format(
        "<path d=\"M{:.0f} 40h24\" stroke=\"{}\" stroke-width=\"3\"/><text x=\"{:.0f}\" y=\"44\">{}</text>\n", x,
        colour, x + 30.0, drives[i].name);
  }
  const double bottom = turn.top_px + kStripPx;
  const double step_s = step_of(duration_s, 8);
  for (int i = 0; i * step_s <= duration_s; ++i)
    body += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{:.0f}</text>\n", speed.x(i * step_s),
                        bottom + 18.0, i * step_s);
  body += fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">time, s</text>\n",
                      0.5 * (kLeftPx + kWidthPx - 20.0), bottom + 36.0);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#f5f7fa\"/>\n<text x=\"{2:.0f}\" y=\"22\" font-size=\"15\" "
      "font-weight=\"bold\">{3}</text>\n{4}</svg>\n",
      kWidthPx, bottom + 46.0, kLeftPx, title, body);
}

}  // namespace aisle::cli
