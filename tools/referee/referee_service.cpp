#include "tools/referee/referee_service.hpp"

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "common/fleet/any_vehicle.hpp"

namespace aisle::referee {
namespace {

using service::Sender;

/// Ground truth is judged this long after its time, so that all of it is there.
constexpr double kJudgeDelay_s = 0.15;
constexpr std::chrono::milliseconds kJudgeEvery{50};
constexpr int kDiscCorners = 32;

/// The judge's shape: a disc is a point with a radius.
Shape shape_of(const geometry::Footprint& footprint) {
  if (footprint.is_disc()) return {footprint.radius_m, 0.0, 0.0};
  return {0.0, footprint.length_m, footprint.width_m};
}

BodyKind kind_of(fleet::Obstacle::Kind kind) {
  switch (kind) {
    case fleet::Obstacle::Kind::kVehicle:
      return BodyKind::kVehicle;
    case fleet::Obstacle::Kind::kPerson:
      return BodyKind::kPerson;
    case fleet::Obstacle::Kind::kBlock:
      break;
  }

  return BodyKind::kBlock;
}

/// Corners of the edited area in map; a disc becomes a polygon.
std::vector<geometry::Point2> outline_of(const fleet::MapEdit& edit) {
  std::vector<geometry::Point2> outline = edit.points_in_map;
  if (edit.shape == fleet::MapEdit::Shape::kRectangle && outline.size() == 2) {
    const geometry::Point2 a = outline[0];
    const geometry::Point2 b = outline[1];
    return {a, {b.x, a.y}, b, {a.x, b.y}};
  }

  if (edit.shape == fleet::MapEdit::Shape::kDisc && outline.size() == 1) {
    const geometry::Point2 center = outline[0];
    outline.clear();

    for (int i = 0; i < kDiscCorners; ++i) {
      const double angle_rad = 2.0 * geometry::kPi * i / kDiscCorners;
      outline.push_back(center + edit.radius_m * geometry::Point2{std::cos(angle_rad), std::sin(angle_rad)});
    }
  }

  return outline;
}

}  // namespace

/// Ground truth is judged a little late, when all of it has come.
RefereeService::RefereeService(service::Shell& shell, const Walls& walls, const Expectation& expectation)
    : shell_(shell), judge_(&walls, expectation), started_(shell.now()), started_wall_ns_(shell.wall_clock_ns()) {
  listen_to_simulation();
  listen_to_fleet();
  listen_to_map_and_services();

  shell.every(kJudgeEvery, [this] { judge_.advance(now_s() - kJudgeDelay_s); });
  shell.report([](service::Health&) {});  // it waits for nothing
}

double RefereeService::now_s() const { return time::seconds(shell_.now() - started_); }

double RefereeService::arrived_s(const Sender& from) const { return time::seconds(from.arrived - started_); }

RunReport RefereeService::finish() { return judge_.finish(now_s()); }

void RefereeService::listen_to_simulation() {
  shell_.inbox<topics::WorldObstacle>([this](const fleet::Obstacle& truth, const Sender& from) { take(truth, from); })
      .on_gone([this](const std::string& id, service::End how) {
        if (how == service::End::kDisposed) judge_.body_gone(id);
      });

  shell_.inbox<topics::VehicleState>(
      [this](const fleet::VehicleState& state, const Sender& from) { take(state, from); });
}

void RefereeService::listen_to_fleet() {
  shell_.inbox<topics::Plan>([this](const fleet::Plan& plan, const Sender& from) { take(plan, from); });

  shell_.inbox<topics::Grant>(
      [this](const fleet::Grant& grant) { judge_.grant_arrived(grant.agv_id, grant.plan_id, grant.limit_m); });

  shell_.inbox<topics::VelocityCommand>([this](const fleet::VelocityCommand& command, const Sender& from) {
    judge_.command_arrived(
        {command.agv_id, from.by.stamp_ns, command.scan_stamp_ns, command.control_ms, arrived_s(from)});
  });

  shell_.inbox<topics::NavigationStatus>(
      [this](const fleet::NavigationStatus& status, const Sender& from) { take(status, from); });
  shell_.inbox<topics::Goal>([this](const fleet::Goal& goal, const Sender& from) { take(goal, from); });
}

void RefereeService::listen_to_map_and_services() {
  shell_.inbox<topics::MapEdit>([this](const fleet::MapEdit& edit, const Sender& from) { take(edit, from); });
  shell_.inbox<topics::MapEditResult>(
      [this](const fleet::MapEditResult& answer, const Sender& from) { take(answer, from); });

  shell_.inbox<topics::MapZones>([this](const fleet::MapZones& map) { judge_.zones_seen(map.zones); });

  shell_.inbox<topics::ServiceHealth>([this](const fleet::ServiceHealth& health, const Sender& from) {
    judge_.health_arrived(
        {health.instance_id, health.service, from.by.boot_id, health.cpu_percent, health.resident_mb});
  });
}

/// Wall clocks are compared here: the simulation and the referee must run on hosts with the same time.
void RefereeService::take(const fleet::Obstacle& truth, const Sender& from) {
  const double t_s = 1e-9 * static_cast<double>(from.by.stamp_ns - started_wall_ns_);
  judge_.body_seen({truth.id, kind_of(truth.kind), shape_of(truth.footprint), truth.base_in_map,
                    geometry::norm(truth.velocity_in_map), t_s, from.by.boot_id, truth.footprint.ahead_m});
}

/// The command in force tells which source the vehicle follows.
void RefereeService::take(const fleet::VehicleState& state, const Sender& from) {
  VehicleReport report;
  report.agv_id = state.agv_id;
  report.boot_id = from.by.boot_id;
  report.t_s = arrived_s(from);
  report.speed_mps = std::fabs(state.motion.twist.linear_mps);

  if (state.command) {
    report.command_agv_id = state.command->agv_id;
    report.command_source = state.command->by.source_id;
    report.command_boot = state.command->by.boot_id;
    report.command_epoch = state.command->by.epoch;
    report.command_sequence = state.command->by.sequence_number;
    report.command_plan_id = state.command->plan_id;
  }

  report.holds = state.hold != fleet::Hold::kNone;
  judge_.vehicle_reported(report, state.refused_commands);
}

/// Stamps are kept beside arrivals: latencies are between stamps.
void RefereeService::take(const fleet::Plan& plan, const Sender& from) {
  PlanNews news;
  news.agv_id = plan.agv_id;
  news.plan_id = plan.id;
  news.goal_id = plan.goal_id;
  news.map_revision = plan.map_revision;

  news.found = plan.is_found();
  news.waypoints_in_map = plan.waypoints_in_map;
  news.has_steps = !plan.step_ends_m.empty();

  news.planning_ms = plan.planning_ms;
  news.stamp_ns = from.by.stamp_ns;

  news.t_s = arrived_s(from);
  judge_.plan_arrived(news);
}

/// A goal for any vehicle counts when a vehicle is given it.
void RefereeService::take(const fleet::Goal& goal, const Sender& from) {
  if (goal.agv_id == fleet::kAnyVehicle) return;

  GoalRecord record;
  record.agv_id = goal.agv_id;
  record.goal_id = goal.id;

  record.pose_in_map = goal.pose_in_map;
  record.position_tolerance_m = goal.position_tolerance_m;
  record.assigned_s = arrived_s(from);
  judge_.goal_arrived(record, goal.is_cancelled);
}

/// A vehicle without a goal does not wait; one that is blocked or held does.
void RefereeService::take(const fleet::NavigationStatus& status, const Sender& from) {
  using fleet::Phase;
  GoalNews news;

  news.agv_id = status.agv_id;
  news.goal_id = status.goal_id;
  news.reason = name(status.phase);
  if (!status.detail.empty()) news.reason += ": " + status.detail;

  news.t_s = arrived_s(from);
  if (status.phase == Phase::kArrived) news.phase = GoalNews::Phase::kArrived;
  if (status.phase == Phase::kFailed) news.phase = GoalNews::Phase::kFailed;

  const bool waits = status.phase == Phase::kBlocked || status.phase == Phase::kHeld ||
                     (status.phase == Phase::kWaiting && status.reason != fleet::Reason::kNoGoal);
  judge_.navigation_arrived(news, waits);
  judge_.plan_named(status.agv_id, status.plan_id, news.t_s);

  std::vector<geometry::Pose2> held_in_map;
  for (const fleet::HeldPose& held : status.held) held_in_map.push_back(held.base_in_map);
  judge_.road_said(status.agv_id, held_in_map, news.t_s);
}

void RefereeService::take(const fleet::MapEdit& edit, const Sender& from) {
  EditRow row;
  row.edit_id = edit.edit_id;
  row.block = edit.action == fleet::MapEdit::Action::kBlock;
  row.outline_in_map = outline_of(edit);

  row.asked_stamp_ns = from.by.stamp_ns;
  row.asked_s = arrived_s(from);
  judge_.edit_asked(row);
}

/// An edit that was applied before counts as answered, not as applied.
void RefereeService::take(const fleet::MapEditResult& answer, const Sender& from) {
  using Outcome = fleet::MapEditResult::Outcome;
  const bool applied = answer.outcome == Outcome::kApplied;

  const std::string outcome = applied                               ? "applied"
                              : answer.outcome == Outcome::kRefused ? "refused: " + answer.detail
                                                                    : "already applied";

  judge_.edit_answered({answer.edit_id, applied, outcome, answer.revision, arrived_s(from)});
}

}  // namespace aisle::referee
