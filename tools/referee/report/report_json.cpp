#include "tools/referee/report/report_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace aisle::referee {
namespace {

using Json = nlohmann::ordered_json;

/// Three decimals: figures for people.
Json number(double value) { return std::round(value * 1e3) / 1e3; }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

/// Median and 99th percentile as two keys.
void quantiles(Json& out, const std::string& name, const Distribution& figures) {
  out[name + "_p50"] = number(figures.quantile(0.5));
  out[name + "_p99"] = number(figures.quantile(0.99));
}

/// With a row of its own for goals that were never given.
Json goals_failed(const RunReport& report) {
  Json failed = Json::array();
  for (const GoalRecord& goal : report.goals) {
    if (goal.outcome == GoalOutcome::kFailed)
      failed.push_back({{"agv", goal.agv_id}, {"goal", goal.goal_id}, {"reason", goal.reason}});
  }

  const int never_given = report.goals_expected - static_cast<int>(report.goals.size());
  if (never_given > 0)
    failed.push_back({{"agv", ""},
                      {"goal", ""},
                      {"reason", std::to_string(never_given) + " goals of the scenario were never given"}});

  return failed;
}

/// One object a contact.
Json contacts_of(const RunReport& report) {
  Json list = Json::array();
  for (const Contact& c : report.contacts) {
    list.push_back({{"kind", name_of(c.pair)},
                    {"a", c.a},
                    {"b", c.b},
                    {"begin_s", number(c.begin_s)},
                    {"end_s", number(c.end_s)},
                    {"x_m", number(c.at_in_map.x)},
                    {"y_m", number(c.at_in_map.y)},
                    {"relative_speed_mps", number(c.relative_speed_mps)},
                    {"vehicle_speed_mps", number(c.vehicle_speed_mps)},
                    {"depth_m", number(c.depth_m)},
                    {"vehicle_moved", c.vehicle_moved()}});
  }

  return list;
}

Json violations_of(const RunReport& report) {
  Json list = Json::array();
  for (const AuthorityViolation& v : report.violations) {
    list.push_back({{"kind", name_of(v.kind)}, {"agv", v.agv_id}, {"t_s", number(v.t_s)}, {"text", v.text}});
  }

  return list;
}

/// Goals are counted by what became of them.
Json vehicle_rows(const RunReport& report) {
  Json rows = Json::array();
  for (const auto& [id, row] : report.vehicles) {
    const auto of_this = [&id = id](const GoalRecord& g) { return g.agv_id == id; };
    const auto reached = std::count_if(report.goals.begin(), report.goals.end(), [&](const GoalRecord& g) {
      return of_this(g) && g.outcome == GoalOutcome::kReached;
    });

    Json out{{"agv", id},
             {"goals_assigned", std::count_if(report.goals.begin(), report.goals.end(), of_this)},
             {"goals_reached", reached},
             {"distance_m", number(row.drive.distance_m())},
             {"max_speed_mps", number(row.drive.max_speed_mps())},
             {"stops", row.drive.stops()},
             {"replans", row.replans},
             {"refused_commands", row.refused_commands},
             {"truth_gap_ms_max", number(row.truth_gap_ms_max)}};
    quantiles(out, "command_gap_ms", row.command_gap_ms);
    out["command_gap_ms_max"] = number(row.command_gap_ms.max());
    quantiles(out, "scan_to_command_ms", row.scan_to_command_ms);
    rows.push_back(std::move(out));
  }

  return rows;
}

Json service_rows(const RunReport& report) {
  Json rows = Json::array();
  for (const auto& [id, row] : report.services) {
    rows.push_back({{"instance", id},
                    {"service", row.service},
                    {"starts", row.starts},
                    {"cpu_percent", number(row.cpu_percent_mean())},
                    {"resident_mb_max", number(row.resident_mb_max)}});
  }

  return rows;
}

Json edit_rows(const RunReport& report) {
  Json rows = Json::array();
  for (const EditRow& edit : report.edits) {
    rows.push_back({{"edit", edit.edit_id},
                    {"action", edit.block ? "block" : "unblock"},
                    {"asked_s", number(edit.asked_s)},
                    {"outcome", edit.outcome.empty() ? "no answer" : edit.outcome},
                    {"revision", edit.revision}});
  }

  return rows;
}

}  // namespace

/// Scripts read these keys: their names are an interface.
nlohmann::ordered_json to_json(const RunReport& report) {
  Json out{{"scenario", report.scenario},
           {"seed", report.seed},
           {"passed", report.passed()},
           {"ended_because", report.ended_because},
           {"duration_s", number(report.duration_s)},
           {"vehicles", report.vehicles.size()},
           {"goals_expected", report.goals_expected},
           {"goals_assigned", report.goals.size()},
           {"goals_reached", report.count(GoalOutcome::kReached)},
           {"goals_failed", goals_failed(report)},
           {"contacts", report.contacts.size()},
           {"contacts_moving_vehicle", report.contacts_moving_vehicle()},
           {"least_clearance_m", number(report.clearances.overall_m())}};
  for (const PairClass pair : kPairClasses) {
    out[std::string("least_clearance_") + name_of(pair) + "_m"] =
        number(report.clearances.least_m[static_cast<std::size_t>(pair)]);
  }

  out["person_clearance_asked_m"] = number(report.person_clearance_m);
  out["distance_m"] = number(report.distance_m());
  out["stops"] = report.stops();
  out["replans"] = report.replans();

  quantiles(out, "planning_ms", report.planning_ms);
  quantiles(out, "control_ms", report.control_ms);
  quantiles(out, "scan_to_command_ms", report.scan_to_command_ms());
  out["map_edit_to_plan_ms_p99"] = number(report.map_edit_to_plan_ms.quantile(0.99));
  quantiles(out, "command_gap_ms", report.command_gap_ms());
  out["command_gap_ms_max"] = number(report.command_gap_ms().max());

  out["cpu_percent_total"] = number(report.cpu_percent_total());
  out["authority_violations"] = report.violations.size();

  out["contact_list"] = contacts_of(report);
  out["authority_violation_list"] = violations_of(report);
  out["vehicle_rows"] = vehicle_rows(report);
  out["service_rows"] = service_rows(report);
  out["map_edits"] = edit_rows(report);

  return out;
}

}  // namespace aisle::referee
