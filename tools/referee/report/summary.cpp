#include "tools/referee/report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace aisle::referee {
namespace {

/// The number with its unit; "-" where nothing was measured.
std::string figure(const std::optional<double>& value, const char* unit, int decimals = 1) {
  return value ? fmt::format("{:.{}f} {}", *value, decimals, unit) : std::string("-");
}

/// Median and 99th percentile.
std::string pair_of(const Distribution& d, const char* unit) {
  return d.count() == 0 ? "-" : fmt::format("{:.1f} / {:.1f} {}", *d.quantile(0.5), *d.quantile(0.99), unit);
}

/// A line with the value in the second column.
std::string row(const char* name, const std::string& value) { return fmt::format("  {:<34}{}\n", name, value); }

/// The least of all, then by kind of pair.
std::string clearances(const RunReport& report) {
  std::string out = row("least clearance", figure(report.clearances.overall_m(), "m", 3));
  const char* names[] = {"  vehicle to vehicle", "  vehicle to person", "  vehicle to block", "  vehicle to wall"};

  for (std::size_t i = 0; i < kPairClasses.size(); ++i) {
    if (report.clearances.least_m[i]) out += row(names[i], figure(report.clearances.least_m[i], "m", 3));
  }

  return out;
}

/// A row a vehicle.
std::string vehicles(const RunReport& report) {
  std::string out = fmt::format("\n  {:<12}{:>8}{:>12}{:>8}{:>9}{:>12}{:>24}\n", "vehicle", "goals", "distance",
                                "stops", "replans", "top speed", "command gap p99 / max");
  for (const auto& [id, v] : report.vehicles) {
    const auto of_this = [&id = id](const GoalRecord& g) { return g.agv_id == id; };
    const auto reached = std::count_if(report.goals.begin(), report.goals.end(), [&](const GoalRecord& g) {
      return of_this(g) && g.outcome == GoalOutcome::kReached;
    });

    const std::string gap =
        v.command_gap_ms.count() == 0
            ? std::string("-")
            : fmt::format("{:.0f} / {:.0f} ms", *v.command_gap_ms.quantile(0.99), *v.command_gap_ms.max());
    out += fmt::format("  {:<12}{:>8}{:>10.1f} m{:>8}{:>9}{:>8.2f} m/s{:>24}\n", id,
                       fmt::format("{}/{}", reached, std::count_if(report.goals.begin(), report.goals.end(), of_this)),
                       v.drive.distance_m(), v.drive.stops(), v.replans, v.drive.max_speed_mps(), gap);
  }

  return out;
}

/// A row a process; empty when none was heard.
std::string services(const RunReport& report) {
  if (report.services.empty()) return {};

  std::string out = fmt::format("\n  {:<30}{:>10}{:>14}{:>8}\n", "process", "CPU", "resident", "starts");
  for (const auto& [id, s] : report.services) {
    out += fmt::format("  {:<30}{:>8.1f} %{:>11.1f} MB{:>8}\n", id, s.cpu_percent_mean(), s.resident_mb_max, s.starts);
  }

  return out;
}

/// Everything because of which a run fails, one line each.
std::string troubles(const RunReport& report) {
  std::string out;
  for (const Contact& c : report.contacts) {
    out += fmt::format("  contact at {:.2f} s: {} and {} at ({:.2f}, {:.2f}), {:.2f} m/s, vehicle {:.2f} m/s\n",
                       c.begin_s, c.a, c.b, c.at_in_map.x, c.at_in_map.y, c.relative_speed_mps, c.vehicle_speed_mps);
  }

  if (report.came_too_near())
    out += fmt::format("  a person was passed nearer than the {:.2f} m that the scenario asks for\n",
                       report.person_clearance_m);

  for (const AuthorityViolation& v : report.violations)
    out += fmt::format("  authority at {:.2f} s: {} {}\n", v.t_s, v.agv_id, v.text);

  for (const GoalRecord& g : report.goals) {
    if (g.outcome == GoalOutcome::kFailed)
      out += fmt::format("  goal missed: {} {}: {}\n", g.agv_id, g.goal_id, g.reason);
  }

  const int never_given = report.goals_expected - static_cast<int>(report.goals.size());
  if (never_given > 0) out += fmt::format("  goals never given: {}\n", never_given);

  return out.empty() ? out : "\n" + out;
}

}  // namespace

/// The figures of the run, then vehicles, processes and troubles.
std::string summary(const RunReport& report) {
  std::string out = fmt::format("{} (seed {}): {} after {:.1f} s, {}\n", report.scenario, report.seed,
                                report.passed() ? "passed" : "FAILED", report.duration_s, report.ended_because);
  out += row("goals reached", fmt::format("{} of {}", report.count(GoalOutcome::kReached), report.goals_expected));
  out += row("contacts (by a moving vehicle)",
             fmt::format("{} ({})", report.contacts.size(), report.contacts_moving_vehicle()));
  out += row("authority violations", std::to_string(report.violations.size()));
  out += clearances(report);
  out += row("distance, stops, replans",
             fmt::format("{:.1f} m, {}, {}", report.distance_m(), report.stops(), report.replans()));
  out += row("planning p50 / p99", pair_of(report.planning_ms, "ms"));
  out += row("control p50 / p99", pair_of(report.control_ms, "ms"));
  out += row("scan to command p50 / p99", pair_of(report.scan_to_command_ms(), "ms"));
  out += row("command gap p50 / p99", pair_of(report.command_gap_ms(), "ms"));
  out += row("map edit to plan p99", figure(report.map_edit_to_plan_ms.quantile(0.99), "ms"));
  out += row("CPU of all services", fmt::format("{:.0f} % of one core", report.cpu_percent_total()));

  return out + vehicles(report) + services(report) + troubles(report);
}

}  // namespace aisle::referee
