#include "tools/referee/core/judge.hpp"

#include <algorithm>
#include <utility>

namespace aisle::referee {
namespace {
constexpr double kBodyTrace_s = 0.1;
constexpr double kMilli = 1e3;
}  // namespace

int Expectation::goals() const {
  int sum = goals_of_any;
  for (const auto& [agv_id, goals] : goals_of) sum += goals;
  return sum;
}

Judge::Judge(const Walls* walls, const Expectation& expectation) : contacts_(walls), expectation_(expectation) {}

Judge::VehicleBook& Judge::vehicle(const std::string& agv_id) {
  VehicleBook& book = vehicles_[agv_id];
  book.row.agv_id = agv_id;
  return book;
}

/// Persons and blocks are traced for the picture; vehicles get their book.
void Judge::body_seen(const BodySample& sample) {
  contacts_.see(sample);
  zones_.body_seen(sample);

  if (sample.kind != BodyKind::kVehicle) {
    trace_body(sample);
    return;
  }

  VehicleBook& book = vehicle(sample.id);
  book.row.shape = sample.shape;
  book.row.ahead_m = sample.ahead_m;
  floor_.shape_seen(sample.id, sample.shape, sample.ahead_m);

  if (book.last_truth_s >= 0.0 && book.truth_boot == sample.boot_id) {
    book.row.truth_gap_ms_max = std::max(book.row.truth_gap_ms_max, (sample.t_s - book.last_truth_s) * kMilli);
  }

  grants_.vehicle_seen(sample.id, sample.base_in_map.position(), sample.t_s);

  book.last_truth_s = sample.t_s;
  book.truth_boot = sample.boot_id;

  const Standing standing = book.holds ? Standing::kHolds : book.waits ? Standing::kWaits : Standing::kNone;
  book.row.drive.drove(sample.t_s, sample.base_in_map, sample.speed_mps, goals_.open_goal(sample.id) != nullptr,
                       standing);
}

/// A point each tenth of a second at most, and only when it moved by 5 cm.
void Judge::trace_body(const BodySample& sample) {
  BodyTrace& trace = bodies_[sample.id];
  trace.kind = sample.kind;
  trace.shape = sample.shape;

  const bool moved =
      trace.way.empty() || geometry::distance(trace.way.back().second.position(), sample.base_in_map.position()) > 0.05;
  if (moved && (trace.way.empty() || sample.t_s - trace.way.back().first >= kBodyTrace_s)) {
    trace.way.emplace_back(sample.t_s, sample.base_in_map);
  }
}

void Judge::body_gone(const std::string& id) {
  contacts_.gone(id);
  zones_.body_gone(id);
}

void Judge::vehicle_reported(const VehicleReport& report, std::uint64_t refused_commands) {
  authority_.vehicle_reported(report);
  grants_.vehicle_reported(report);
  VehicleBook& book = vehicle(report.agv_id);
  book.row.refused_commands = std::max(book.row.refused_commands, refused_commands);
  book.holds = report.holds;
}

/// A plan with another id for the same goal is a replan. It ends the wait of an edit whose revision it
/// knows.
void Judge::plan_arrived(const PlanNews& plan) {
  authority_.plan_arrived(plan.agv_id, plan.plan_id, plan.found, plan.t_s);
  grants_.plan_arrived(plan.agv_id, plan.plan_id, plan.waypoints_in_map, plan.has_steps);

  VehicleBook& book = vehicle(plan.agv_id);
  const bool is_new = !book.has_plan || book.plan_id != plan.plan_id;

  if (is_new) {
    if (book.has_plan && book.planned_goal == plan.goal_id) ++book.row.replans;
    planning_ms_.add(plan.planning_ms);
    if (plan.found) book.row.plans.push_back({plan.t_s, plan.waypoints_in_map});
  }

  book.has_plan = true;
  book.plan_id = plan.plan_id;
  book.planned_goal = plan.goal_id;
  book.plan_revision = plan.map_revision;
  book.plan_stamp_ns = plan.stamp_ns;

  // Edits that this plan is the first to know of.
  for (PendingEdit& edit : pending_edits_) {
    const auto waits = std::find(edit.waiting.begin(), edit.waiting.end(), plan.agv_id);
    if (waits == edit.waiting.end() || plan.map_revision < edit.revision) continue;
    edit_planned_for(edit.asked_stamp_ns, plan.stamp_ns);
    edit.waiting.erase(waits);
  }
}

/// Gaps are between arrivals; scan to command is between the two stamps, once for each new scan.
void Judge::command_arrived(const CommandNews& command) {
  VehicleBook& book = vehicle(command.agv_id);
  if (book.last_command_s >= 0.0) book.row.command_gap_ms.add((command.t_s - book.last_command_s) * kMilli);
  book.last_command_s = command.t_s;
  control_ms_.add(command.control_ms);

  if (command.scan_stamp_ns > book.last_scan_stamp_ns) {
    book.last_scan_stamp_ns = command.scan_stamp_ns;
    book.row.scan_to_command_ms.add(static_cast<double>(command.stamp_ns - command.scan_stamp_ns) / 1e6);
  }
}

void Judge::goal_arrived(const GoalRecord& goal, bool cancelled) { goals_.assigned(goal, cancelled); }

void Judge::grant_arrived(const std::string& agv_id, std::uint64_t plan_id, double limit_m) {
  grants_.grant_arrived(agv_id, plan_id, limit_m);
}

void Judge::plan_named(const std::string& agv_id, std::uint64_t plan_id, double t_s) {
  authority_.plan_named(agv_id, plan_id, t_s);
}

void Judge::road_said(const std::string& agv_id, const std::vector<geometry::Pose2>& held_in_map, double t_s) {
  floor_.road_said(agv_id, held_in_map, t_s);
}

void Judge::navigation_arrived(const GoalNews& news, bool waits) {
  VehicleBook& book = vehicle(news.agv_id);
  book.waits = waits;
  if (book.row.drive.seen()) goals_.heard(news, book.row.drive.base_in_map());
}

void Judge::edit_asked(const EditRow& edit) {
  const bool known =
      std::any_of(edits_.begin(), edits_.end(), [&](const EditRow& e) { return e.edit_id == edit.edit_id; });
  if (!known) edits_.push_back(edit);
}

void Judge::edit_planned_for(std::int64_t asked_stamp_ns, std::int64_t plan_stamp_ns) {
  map_edit_to_plan_ms_.add(static_cast<double>(plan_stamp_ns - asked_stamp_ns) / 1e6);
}

/// Vehicles without an open goal plan nothing, and are not waited for.
void Judge::edit_answered(const EditAnswer& answer) {
  const auto row =
      std::find_if(edits_.begin(), edits_.end(), [&](const EditRow& e) { return e.edit_id == answer.edit_id; });
  if (row == edits_.end() || row->answered_s >= 0.0) return;

  row->answered_s = answer.t_s;
  row->outcome = answer.outcome;
  row->revision = answer.revision;

  if (!answer.applied) return;

  // Vehicles that must plan anew; some may have done so before the answer came.
  PendingEdit pending{row->asked_stamp_ns, answer.revision, {}};
  for (const auto& [agv_id, book] : vehicles_) {
    if (goals_.open_goal(agv_id) == nullptr || !book.has_plan) continue;

    if (book.plan_revision >= answer.revision) {
      edit_planned_for(row->asked_stamp_ns, book.plan_stamp_ns);  // the plan was faster on the wire than the answer
    } else {
      pending.waiting.push_back(agv_id);
    }
  }

  pending_edits_.push_back(std::move(pending));
}

/// CPU is said for the time since the sample before: the first of a start does not count.
void Judge::health_arrived(const HealthNews& health) {
  ServiceRow& row = services_[health.instance];
  row.instance = health.instance;
  row.service = health.service;

  std::uint64_t& boot = boots_[health.instance];
  if (row.starts == 0 || boot != health.boot_id) {
    ++row.starts;
    boot = health.boot_id;
  } else {
    row.cpu_percent_sum += health.cpu_percent;  // the first sample of a start has no sample before it
    ++row.cpu_samples;
  }

  row.resident_mb_max = std::max(row.resident_mb_max, health.resident_mb);
}

void Judge::advance(double until_s) { contacts_.advance(until_s); }

/// A goal taken from a vehicle is cancelled there, and counts where it is given again.
bool Judge::are_tasks_over(double now_s) const {
  int over = 0;
  for (const GoalRecord& goal : goals_.all()) {
    const bool is_open = goal.outcome == GoalOutcome::kOpen;
    const bool is_given_up = is_open && goal.failing_since_s >= 0.0 && now_s - goal.failing_since_s >= kGiveUp_s;
    if (is_open && !is_given_up) return false;
    if (goal.outcome != GoalOutcome::kCancelled) ++over;
  }

  return over >= expectation_.goals();
}

/// Vehicles that were never seen stand still for all we know.
bool Judge::is_over(double now_s) const {
  if (expectation_.goals() == 0) return false;
  if (expectation_.goals_of_any > 0 && !are_tasks_over(now_s)) return false;

  for (const auto& [agv_id, expected] : expectation_.goals_of) {
    const GoalRecord* open = goals_.open_goal(agv_id);
    const bool given_up = open != nullptr && open->failing_since_s >= 0.0 && now_s - open->failing_since_s >= kGiveUp_s;
    const bool done = open == nullptr && goals_.assigned_count(agv_id) >= expected;
    if (!given_up && !done) return false;
  }

  return std::all_of(vehicles_.begin(), vehicles_.end(), [&](const auto& entry) {
    const DriveBook& drive = entry.second.row.drive;
    return !drive.seen() || (drive.stands() && now_s - drive.stands_since_s() >= kSettle_s);
  });
}

/// Contacts and goals are closed first, since the report copies them.
RunReport Judge::finish(double t_s) {
  contacts_.advance(t_s);
  goals_.close(t_s);

  RunReport report;
  report.duration_s = t_s;

  report.goals_expected = std::max(expectation_.goals(), goals_.assigned_count());
  report.goals = goals_.all();

  report.contacts = contacts_.contacts();
  report.clearances = contacts_.clearances();
  report.violations = authority_.violations();
  for (const auto* more : {&grants_.violations(), &floor_.violations(), &zones_.violations()})
    report.violations.insert(report.violations.end(), more->begin(), more->end());
  std::stable_sort(report.violations.begin(), report.violations.end(),
                   [](const AuthorityViolation& a, const AuthorityViolation& b) { return a.t_s < b.t_s; });

  for (const auto& [agv_id, book] : vehicles_) report.vehicles.emplace(agv_id, book.row);
  report.bodies = bodies_;

  report.edits = edits_;
  report.services = services_;

  report.planning_ms = planning_ms_;
  report.control_ms = control_ms_;
  report.map_edit_to_plan_ms = map_edit_to_plan_ms_;

  return report;
}

}  // namespace aisle::referee
