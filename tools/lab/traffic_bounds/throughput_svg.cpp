#include "tools/lab/traffic_bounds/throughput_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "tools/draw/chart.hpp"
#include "tools/draw/colours.hpp"
#include "tools/draw/legend.hpp"
#include "tools/draw/svg.hpp"

namespace aisle::lab {
namespace {

constexpr int kWidthPx = 900;
constexpr int kLeftPx = 60;
constexpr int kRightPx = 20;
constexpr int kTopPx = 76;
constexpr int kChartPx = 240;
constexpr int kBetweenPx = 80;
constexpr int kKeyPx = 200;  // from one curve's name to the next

/// A curve of the chart: its name, and its value in a row, if it has one.
struct Curve {
  const char* name;
  std::function<std::optional<double>(const FleetRow&)> of;
  const char* attributes;  // beside the colour
};

std::optional<double> rate(const std::optional<ReachedFigures>& reached) {
  return reached ? std::optional(reached->goals_per_vehicle_hour) : std::nullopt;
}

const std::vector<Curve>& curves() {
  static const std::vector<Curve> all{
      {"reached", [](const FleetRow& row) { return rate(row.reached); }, "stroke-width=\"2.5\""},
      {"PIBT bound", [](const FleetRow& row) { return std::optional(row.bound); },
       "stroke-width=\"1.5\" stroke-dasharray=\"6 4\""},
      {"alone", [](const FleetRow& row) { return row.alone; }, "stroke-width=\"1.5\" stroke-dasharray=\"2 3\""},
      {"simulated site", [](const FleetRow& row) { return rate(row.site); }, "stroke-width=\"2.5\""},
  };
  return all;
}

/// The points of the curve, from the smallest fleet to the largest.
std::vector<draw::Sample> samples_of(const FloorFigures& floor, const Curve& curve) {
  std::vector<draw::Sample> samples;
  for (const FleetRow& row : floor.rows) {
    const std::optional<double> value = curve.of(row);
    if (value && std::isfinite(*value)) samples.push_back({static_cast<double>(row.vehicles), *value});
  }

  std::sort(samples.begin(), samples.end(), [](const draw::Sample& a, const draw::Sample& b) { return a.t_s < b.t_s; });
  return samples;
}

/// Lines at round rates, and the sizes of the fleets below.
std::string axes(const draw::Chart& chart, const FloorFigures& floor) {
  std::string svg = draw::chart_box(chart) + "\n" +
                    draw::text(kLeftPx, chart.top_px - 8, "", floor.floor + ", goals a vehicle and hour") + "\n";

  const double step = draw::round_step(chart.high, 6);
  for (int i = 0; i * step <= chart.high + 1e-9; ++i)
    svg += draw::value_line(chart, i * step, draw::kGridLine, "text-anchor=\"end\"") + "\n";

  for (const FleetRow& row : floor.rows)
    svg += draw::text(chart.x(static_cast<double>(row.vehicles)), chart.bottom_px() + 18, "text-anchor=\"middle\"",
                      fmt::format("{}", row.vehicles)) +
           "\n";

  return svg +
         draw::text((kLeftPx + chart.right_px()) / 2, chart.bottom_px() + 36, "text-anchor=\"middle\"", "vehicles") +
         "\n";
}

/// A chart over vehicles, where others are over time.
std::string chart_of(const FloorFigures& floor, int top_px) {
  double most_vehicles = 1.0, high = 1.0;
  for (const FleetRow& row : floor.rows) most_vehicles = std::max(most_vehicles, static_cast<double>(row.vehicles));
  for (const Curve& curve : curves())
    for (const draw::Sample& sample : samples_of(floor, curve)) high = std::max(high, sample.value);

  const draw::Chart chart{kLeftPx, top_px,     kWidthPx - kLeftPx - kRightPx, kChartPx, 1.04 * most_vehicles,
                          0.0,     1.05 * high};
  std::string svg = axes(chart, floor);

  for (std::size_t i = 0; i < curves().size(); ++i) {
    const std::vector<draw::Sample> samples = samples_of(floor, curves()[i]);
    if (samples.empty()) continue;

    svg +=
        draw::path(draw::curve(chart, samples), fmt::format("fill=\"none\" stroke=\"{}\" stroke-linejoin=\"round\" {}",
                                                            draw::colour(i), curves()[i].attributes)) +
        "\n";
    for (const draw::Sample& sample : samples)
      svg += draw::circle(chart.x(sample.t_s), chart.y(sample.value), 3, fmt::format("fill=\"{}\"", draw::colour(i))) +
             "\n";
  }

  return svg;
}

}  // namespace

std::string throughput_svg(const std::vector<FloorFigures>& floors) {
  std::string body = draw::text(kLeftPx, 22, "font-size=\"15\" font-weight=\"bold\"",
                                "What the traffic reaches, and what it cannot exceed") +
                     "\n";

  int keys = 0;
  for (std::size_t i = 0; i < curves().size(); ++i) {
    const bool is_drawn = std::any_of(floors.begin(), floors.end(), [&](const FloorFigures& floor) {
      return !samples_of(floor, curves()[i]).empty();
    });
    if (is_drawn) body += draw::curve_key(kLeftPx + kKeyPx * keys++, 42, draw::colour(i), curves()[i].name);
  }

  int top_px = kTopPx;
  for (const FloorFigures& floor : floors) {
    body += chart_of(floor, top_px);
    top_px += kChartPx + kBetweenPx;
  }

  return draw::document({kWidthPx, top_px - kBetweenPx + 50, std::string(draw::kSansSerif) + " font-size=\"12\""},
                        body);
}

}  // namespace aisle::lab
