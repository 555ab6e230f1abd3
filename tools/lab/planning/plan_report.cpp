#include "tools/lab/planning/plan_report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace aisle::lab {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

}  // namespace

/// JSON knows no numbers that are not finite.
Json json_of(const std::vector<Tally>& tallies) {
  Json all = Json::array();
  for (const Tally& t : tallies) {
    all.push_back({{"planner", t.planner()},
                   {"asked", t.asked()},
                   {"solved", t.solved()},
                   {"checker_failures", t.checker_failures()},
                   {"length_ratio_mean", number(t.length_ratio_mean())},
                   {"length_ratio_max", number(t.length_ratio_max())},
                   {"nodes_mean", number(t.nodes_mean())},
                   {"turning_points_mean", number(t.turning_points_mean())},
                   {"turning_angle_mean_rad", number(t.turning_angle_mean_rad())},
                   {"expanded_mean", number(t.expanded_mean())},
                   {"time_us_p50", number(t.time_us(0.5))},
                   {"time_us_p99", number(t.time_us(0.99))},
                   {"least_clearance_m", t.solved() > 0 ? number(t.least_clearance_m()) : Json(nullptr)}});
  }

  return all;
}

std::vector<std::vector<std::string>> rows_of(const std::vector<Tally>& tallies) {
  std::vector<std::vector<std::string>> rows{{"planner", "asked", "solved", "faults", "length m", "ratio", "ratio max",
                                              "nodes", "turns", "turned rad", "expanded", "p50 us", "p99 us",
                                              "clearance m"}};
  for (const Tally& t : tallies) {
    rows.push_back({t.planner(), std::to_string(t.asked()), std::to_string(t.solved()),
                    std::to_string(t.checker_failures()), text(t.length_mean_m(), 3), text(t.length_ratio_mean(), 5),
                    text(t.length_ratio_max(), 5), text(t.nodes_mean(), 1), text(t.turning_points_mean(), 1),
                    text(t.turning_angle_mean_rad(), 2), text(t.expanded_mean(), 0), text(t.time_us(0.5), 1),
                    text(t.time_us(0.99), 1), t.solved() > 0 ? text(t.least_clearance_m(), 3) : "-"});
  }

  return rows;
}

}  // namespace aisle::lab
