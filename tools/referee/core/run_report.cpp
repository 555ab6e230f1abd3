#include "tools/referee/core/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>

namespace aisle::referee {

int RunReport::count(GoalOutcome outcome) const {
  return static_cast<int>(
      std::count_if(goals.begin(), goals.end(), [&](const GoalRecord& g) { return g.outcome == outcome; }));
}

/// Goals that were never given are missed as well.
int RunReport::goals_missed() const {
  return goals_expected - count(GoalOutcome::kReached) - count(GoalOutcome::kCancelled);
}

int RunReport::contacts_moving_vehicle() const {
  return static_cast<int>(
      std::count_if(contacts.begin(), contacts.end(), [](const Contact& c) { return c.vehicle_moved(); }));
}

double RunReport::distance_m() const {
  return std::accumulate(vehicles.begin(), vehicles.end(), 0.0,
                         [](double sum, const auto& v) { return sum + v.second.drive.distance_m(); });
}

int RunReport::stops() const {
  return std::accumulate(vehicles.begin(), vehicles.end(), 0,
                         [](int sum, const auto& v) { return sum + v.second.drive.stops(); });
}

int RunReport::replans() const {
  return std::accumulate(vehicles.begin(), vehicles.end(), 0,
                         [](int sum, const auto& v) { return sum + v.second.replans; });
}

Distribution RunReport::command_gap_ms() const {
  Distribution all;
  for (const auto& [id, row] : vehicles) all.add_all(row.command_gap_ms);
  return all;
}

Distribution RunReport::scan_to_command_ms() const {
  Distribution all;
  for (const auto& [id, row] : vehicles) all.add_all(row.scan_to_command_ms);
  return all;
}

double RunReport::cpu_percent_total() const {
  double sum = 0.0;
  for (const auto& [id, row] : services) {
    if (row.service != "referee") sum += row.cpu_percent_mean();
  }

  return sum;
}

/// Each line begins with its second.
std::vector<std::string> RunReport::troubles() const {
  std::vector<std::string> lines;
  for (const Contact& c : contacts)
    lines.push_back(
        fmt::format("{:8.3f} CONTACT {} {} {}", c.begin_s, c.a, c.b, c.vehicle_moved() ? "moving" : "standing"));

  for (const AuthorityViolation& v : violations)
    lines.push_back(fmt::format("{:8.3f} VIOLATION of authority: {} {}", v.t_s, v.agv_id, v.text));

  for (const GoalRecord& goal : goals)
    if (goal.outcome == GoalOutcome::kFailed)
      lines.push_back(fmt::format("{:8.3f} {} goal missed: {} {}", duration_s, goal.agv_id, goal.goal_id, goal.reason));

  const int never_given = goals_expected - static_cast<int>(goals.size());
  if (never_given > 0) lines.push_back(fmt::format("{:8.3f} goals never given: {}", duration_s, never_given));

  return lines;
}

bool RunReport::came_too_near() const {
  const std::optional<double>& least_m = clearances.least_m[static_cast<std::size_t>(PairClass::kVehiclePerson)];
  return person_clearance_m > 0.0 && least_m && *least_m < person_clearance_m;
}

/// A recorded person may walk into a vehicle that stands; that is no fault of the vehicle's.
bool RunReport::passed() const {
  const bool touched = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return c.vehicle_moved() || c.pair != PairClass::kVehiclePerson || people_give_way;
  });

  return goals_missed() == 0 && !touched && !came_too_near() && violations.empty();
}

}  // namespace aisle::referee
