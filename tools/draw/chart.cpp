#include "tools/draw/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/draw/colours.hpp"

namespace aisle::draw {

/// The power of ten at or below the exact step, then the first of its multiples that is enough.
double round_step(double span, int most) {
  const double least = span / most;
  const double power = std::pow(10.0, std::floor(std::log10(least)));

  for (const double times : {1.0, 2.0, 5.0})
    if (least <= times * power) return times * power;

  return 10.0 * power;
}

double Chart::x(double t_s) const { return left_px + std::clamp(t_s / duration_s, 0.0, 1.0) * width_px; }

double Chart::y(double value) const {
  return top_px + std::clamp(height_px * (high - value) / (high - low), 0.0, double(height_px));
}

std::string chart_box(const Chart& chart) {
  return rect(chart.left_px, chart.top_px, chart.width_px, chart.height_px,
              fmt::format("fill=\"#ffffff\" stroke=\"{}\"", kBorder));
}

std::string value_line(const Chart& chart, double value, std::string_view stroke, std::string_view text_attributes) {
  constexpr int kGapPx = 6;             // between the number and the box
  constexpr double kHalfDigitPx = 4.0;  // a number's middle stands above its foot

  return path(fmt::format("M{} {:.1f}H{}", chart.left_px, chart.y(value), chart.right_px()),
              fmt::format("stroke=\"{}\"", stroke)) +
         text(chart.left_px - kGapPx, chart.y(value) + kHalfDigitPx, text_attributes, fmt::format("{:.1f}", value));
}

std::string curve(const Chart& chart, const std::vector<Sample>& samples) {
  std::vector<PointPx> points;
  points.reserve(samples.size());
  for (const Sample& sample : samples) points.push_back({chart.x(sample.t_s), chart.y(sample.value)});
  return path_along(points);
}

}  // namespace aisle::draw
