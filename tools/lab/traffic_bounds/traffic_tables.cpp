#include "tools/lab/traffic_bounds/traffic_tables.hpp"

#include <fmt/format.h>

#include <cmath>

namespace aisle::lab {
namespace {

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string number(const std::optional<double>& value, int digits) { return value ? number(*value, digits) : "-"; }

std::string ratio(double over, double under) { return number(under > 0.0 ? over / under : NAN, 2); }

/// What both kinds of runs have in common.
std::vector<std::string> reached_cells(const ReachedFigures& reached) {
  return {number(reached.goals_per_vehicle_hour, 1),
          fmt::format("{}", reached.goals),
          fmt::format("{} to {}", reached.least_served, reached.most_served),
          number(reached.time_to_alone, 2),
          number(reached.own_way_share, 2),
          number(reached.wait.seconds, 1),
          number(reached.standoff.seconds, 1),
          fmt::format("{}", reached.findings)};
}

const std::vector<std::string> kReachedNames{"reached",  "goals",  "a vehicle",   "time / alone",
                                             "own ways", "wait s", "stand-off s", "findings"};

void append(std::vector<std::string>& row, const std::vector<std::string>& more) {
  row.insert(row.end(), more.begin(), more.end());
}

void add_remarks(std::vector<std::string>& lines, std::size_t vehicles, const char* where,
                 const ReachedFigures& reached) {
  if (!reached.wait.cause.empty())
    lines.push_back(fmt::format("{} vehicles{}: longest wait {:.1f} s, {}", vehicles, where, reached.wait.seconds,
                                reached.wait.cause));
  if (!reached.standoff.cause.empty())
    lines.push_back(fmt::format("{} vehicles{}: longest stand-off {:.1f} s, {}", vehicles, where,
                                reached.standoff.seconds, reached.standoff.cause));
  if (reached.findings > 0)
    lines.push_back(
        fmt::format("{} vehicles{}: {} findings, {}", vehicles, where, reached.findings, reached.first_finding));
}

}  // namespace

Cells throughput_table(const FloorFigures& floor) {
  Cells table{{"vehicles", "alone", "bound", "of roadmap", "bound / reached"}};
  append(table.front(), kReachedNames);

  for (const FleetRow& row : floor.rows) {
    if (!row.reached) continue;
    table.push_back({fmt::format("{}", row.vehicles), number(row.alone, 1), number(row.bound, 1),
                     number(row.roadmap_bound, 1), ratio(row.bound, row.reached->goals_per_vehicle_hour)});
    append(table.back(), reached_cells(*row.reached));
  }

  return table;
}

Cells site_table(const FloorFigures& floor) {
  Cells table{{"vehicles", "bound", "bound / reached"}};
  append(table.front(), kReachedNames);

  for (const FleetRow& row : floor.rows) {
    if (!row.site) continue;
    table.push_back({fmt::format("{}", row.vehicles), number(row.site_bound, 1),
                     ratio(row.site_bound.value_or(NAN), row.site->goals_per_vehicle_hour)});
    append(table.back(), reached_cells(*row.site));
  }

  return table;
}

Cells one_shot_table(const FloorFigures& floor) {
  Cells table{{"vehicles", "goals", "makespan s", "alone s", "sum s", "sum / alone", "plan / shortest", "one shot",
               "planned", "forecast / alone"}};

  for (const FleetRow& row : floor.rows) {
    table.push_back({fmt::format("{}", row.vehicles)});
    if (row.one_shot) {
      const OneShotFigures& shot = *row.one_shot;
      append(table.back(),
             {fmt::format("{}", shot.goals), number(shot.makespan_s, 1), number(shot.alone_makespan_s, 1),
              number(shot.ends_s, 1), number(shot.stretch(), 2),
              shot.plan_cost > 0 ? number(shot.plan_stretch(), 2) : "-", number(shot.ratio(row.vehicles), 2)});
    } else {
      append(table.back(), std::vector<std::string>(7, "-"));
    }

    append(table.back(), {fmt::format("{}", row.plans.planned), number(row.plans.stretch(), 2)});
  }

  return table;
}

Cells time_table(const FloorFigures& floor) {
  Cells table{{"vehicles", "cycle mean ms", "cycle p99 ms", "plans from nothing s"}};

  for (const FleetRow& row : floor.rows)
    table.push_back({fmt::format("{}", row.vehicles), row.reached ? number(row.reached->step_ms_mean, 2) : "-",
                     row.reached ? number(row.reached->step_ms_p99, 2) : "-", number(row.plans.cpu_s, 2)});

  return table;
}

std::vector<std::string> remarks(const FloorFigures& floor) {
  std::vector<std::string> lines;
  for (const FleetRow& row : floor.rows) {
    if (row.reached) add_remarks(lines, row.vehicles, "", *row.reached);
    if (row.site) add_remarks(lines, row.vehicles, " on the site", *row.site);
  }
  return lines;
}

}  // namespace aisle::lab
