#include "tools/referee/referee_service.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/wire/geometry.hpp"

namespace aisle::referee {
namespace {

using bus::SampleInfo;
using bus::SampleKind;

/// Ground truth is judged this long after its time, so that all of it is there.
constexpr double kJudgeDelay_s = 0.15;
constexpr int kDiscCorners = 32;

const char* name_of(NavigationPhase phase) {
  switch (phase) {
    case NavigationPhase::PHASE_WAITING:
      return "waiting";
    case NavigationPhase::PHASE_TURNING:
      return "turning";
    case NavigationPhase::PHASE_DRIVING:
      return "driving";
    case NavigationPhase::PHASE_AVOIDING:
      return "avoiding";
    case NavigationPhase::PHASE_BLOCKED:
      return "blocked";
    case NavigationPhase::PHASE_ARRIVED:
      return "arrived";
    case NavigationPhase::PHASE_FAILED:
      return "failed";
    case NavigationPhase::PHASE_HELD:
      return "held";
  }
  return "unknown";
}

Shape shape_of(const aisle::WorldObstacle& sample) {
  if (sample.shape() == FootprintKind::FOOTPRINT_DISC) return {sample.radius_m(), 0.0, 0.0};
  return {0.0, sample.length_m(), sample.width_m()};
}

BodyKind kind_of(aisle::BodyKind kind) {
  switch (kind) {
    case aisle::BodyKind::BODY_VEHICLE:
      return BodyKind::kVehicle;
    case aisle::BodyKind::BODY_PERSON:
      return BodyKind::kPerson;
    case aisle::BodyKind::BODY_BLOCK:
      break;
  }
  return BodyKind::kBlock;
}

std::vector<geometry::Point2> outline_of(const aisle::MapEdit& edit) {
  std::vector<geometry::Point2> outline;
  for (const aisle::Point& p : edit.points()) outline.push_back({p.x_m(), p.y_m()});
  if (edit.shape() == EditShape::SHAPE_RECTANGLE && outline.size() == 2) {
    const geometry::Point2 a = outline[0];
    const geometry::Point2 b = outline[1];
    return {a, {b.x, a.y}, b, {a.x, b.y}};
  }
  if (edit.shape() == EditShape::SHAPE_DISC && outline.size() == 1) {
    const geometry::Point2 center = outline[0];
    outline.clear();
    for (int i = 0; i < kDiscCorners; ++i) {
      const double angle_rad = 2.0 * geometry::kPi * i / kDiscCorners;
      outline.push_back(center + edit.radius_m() * geometry::Point2{std::cos(angle_rad), std::sin(angle_rad)});
    }
  }
  return outline;
}

bool all_finite(const std::vector<geometry::Point2>& points) {
  return std::all_of(points.begin(), points.end(), [](geometry::Point2 p) { return geometry::is_finite(p); });
}

}  // namespace

RefereeService::RefereeService(bus::Bus& bus, service::Health& health, const Walls& walls,
                               const Expectation& expectation)
    : bus_(bus),
      health_(health),
      judge_(&walls, expectation),
      started_(bus.now()),
      started_wall_ns_(bus.wall_clock_ns()) {
  listen_to_simulation(bus);
  listen_to_fleet(bus);
  listen_to_map(bus);
  listen_to_services(bus);
  bus.every(std::chrono::milliseconds(50), [this] { judge_.advance(now_s() - kJudgeDelay_s); });
  health_.state = fleet::ServiceState::kReady;
}

double RefereeService::now_s() const { return time::seconds(bus_.now() - started_); }

double RefereeService::arrived_s(const SampleInfo& info) const { return time::seconds(info.arrived - started_); }

bool RefereeService::fit(const char* topic, bool ok) {
  if (!ok) health_.count(std::string("unfit_") + topic);
  return ok;
}

RunReport RefereeService::finish() { return judge_.finish(now_s()); }

void RefereeService::listen_to_simulation(bus::Bus& bus) {
  bus.on<topics::WorldObstacle>([this](const aisle::WorldObstacle& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample);
    if (info.kind == SampleKind::kDisposed) judge_.body_gone(sample.obstacle_id().to_string());
  });
  bus.on<topics::VehicleState>([this](const aisle::VehicleState& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample, arrived_s(info));
  });
}

void RefereeService::listen_to_fleet(bus::Bus& bus) {
  bus.on<topics::Plan>([this](const aisle::Plan& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample, arrived_s(info));
  });
  bus.on<topics::VelocityCommand>([this](const aisle::VelocityCommand& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    judge_.command_arrived({sample.agv_id().to_string(), sample.by().stamp_ns(), sample.scan_stamp_ns(),
                            sample.control_ms(), arrived_s(info)});
  });
  bus.on<topics::NavigationStatus>([this](const aisle::NavigationStatus& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample, arrived_s(info));
  });
  bus.on<topics::Goal>([this](const aisle::Goal& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample, arrived_s(info));
  });
}

void RefereeService::listen_to_map(bus::Bus& bus) {
  bus.on<topics::MapEdit>([this](const aisle::MapEdit& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample, arrived_s(info));
  });
  bus.on<topics::MapEditResult>([this](const aisle::MapEditResult& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample, arrived_s(info));
  });
}

void RefereeService::listen_to_services(bus::Bus& bus) {
  bus.on<topics::ServiceHealth>([this](const aisle::ServiceHealth& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    judge_.health_arrived({sample.instance_id().to_string(), sample.service().to_string(), sample.by().boot_id(),
                           sample.cpu_percent(), sample.resident_mb()});
  });
}

void RefereeService::take(const aisle::WorldObstacle& sample) {
  wire::Checks checks;
  const geometry::Pose2 base_in_map = wire::decode(sample.base_in_map(), checks);
  checks.within("radius_m", sample.radius_m(), 0.0, 100.0)
      .within("length_m", sample.length_m(), 0.0, 100.0)
      .within("width_m", sample.width_m(), 0.0, 100.0)
      .within("ahead_m", sample.ahead_m(), -100.0, 100.0);
  checks.within("velocity_x_mps", sample.velocity_x_mps(), -100.0, 100.0)
      .within("velocity_y_mps", sample.velocity_y_mps(), -100.0, 100.0);
  if (!fit("world_obstacle", checks.ok())) return;
  const double t_s = 1e-9 * static_cast<double>(sample.by().stamp_ns() - started_wall_ns_);
  judge_.body_seen({sample.obstacle_id().to_string(), kind_of(sample.kind()), shape_of(sample), base_in_map,
                    std::hypot(sample.velocity_x_mps(), sample.velocity_y_mps()), t_s, sample.by().boot_id(),
                    sample.ahead_m()});
}

void RefereeService::take(const aisle::VehicleState& sample, double t_s) {
  if (!fit("vehicle_state", std::isfinite(sample.twist().linear_mps()))) return;
  VehicleReport report;
  report.agv_id = sample.agv_id().to_string();
  report.boot_id = sample.by().boot_id();
  report.t_s = t_s;
  report.speed_mps = std::fabs(sample.twist().linear_mps());
  report.command_agv_id = sample.command_agv_id().to_string();
  report.command_source = sample.command_by().source_id().to_string();
  report.command_boot = sample.command_by().boot_id();
  report.command_epoch = sample.command_by().epoch();
  report.command_sequence = sample.command_by().sequence_number();
  report.command_plan_id = sample.command_plan_id();
  report.holds = sample.hold() != HoldReason::HOLD_NONE;
  judge_.vehicle_reported(report, sample.refused_commands());
}

void RefereeService::take(const aisle::Plan& sample, double t_s) {
  PlanNews plan;
  plan.agv_id = sample.agv_id().to_string();
  plan.plan_id = sample.plan_id();
  plan.goal_id = sample.goal_id().to_string();
  plan.map_revision = sample.map_revision();
  plan.found = sample.outcome() == PlanOutcome::PLAN_FOUND;
  for (const aisle::Point& p : sample.waypoints_in_map()) plan.waypoints_in_map.push_back({p.x_m(), p.y_m()});
  plan.planning_ms = sample.planning_ms();
  plan.stamp_ns = sample.by().stamp_ns();
  plan.t_s = t_s;
  if (fit("plan", all_finite(plan.waypoints_in_map) && std::isfinite(plan.planning_ms))) judge_.plan_arrived(plan);
}

void RefereeService::take(const aisle::Goal& sample, double t_s) {
  wire::Checks checks;
  GoalRecord goal;
  goal.agv_id = sample.agv_id().to_string();
  goal.goal_id = sample.goal_id().to_string();
  goal.pose_in_map = wire::decode(sample.pose_in_map(), checks);
  goal.position_tolerance_m = sample.position_tolerance_m();
  goal.assigned_s = t_s;
  checks.within("position_tolerance_m", goal.position_tolerance_m, 0.0, 10.0);
  if (fit("goal", checks.ok())) judge_.goal_arrived(goal, sample.cancelled());
}

void RefereeService::take(const aisle::NavigationStatus& sample, double t_s) {
  const NavigationPhase phase = sample.phase();
  GoalNews news;
  news.agv_id = sample.agv_id().to_string();
  news.goal_id = sample.goal_id().to_string();
  news.reason = name_of(phase);
  if (const std::string detail = sample.detail().to_string(); !detail.empty()) news.reason += ": " + detail;
  news.t_s = t_s;
  if (phase == NavigationPhase::PHASE_ARRIVED) news.phase = GoalNews::Phase::kArrived;
  if (phase == NavigationPhase::PHASE_FAILED) news.phase = GoalNews::Phase::kFailed;
  const bool waits = phase == NavigationPhase::PHASE_BLOCKED || phase == NavigationPhase::PHASE_HELD ||
                     (phase == NavigationPhase::PHASE_WAITING && sample.reason() != NavigationReason::REASON_NO_GOAL);
  judge_.navigation_arrived(news, waits);
}

void RefereeService::take(const aisle::MapEdit& sample, double t_s) {
  EditRow edit;
  edit.edit_id = sample.edit_id().to_string();
  edit.block = sample.action() == EditAction::EDIT_BLOCK;
  edit.outline_in_map = outline_of(sample);
  edit.asked_stamp_ns = sample.by().stamp_ns();
  edit.asked_s = t_s;
  if (fit("map_edit", all_finite(edit.outline_in_map))) judge_.edit_asked(edit);
}

void RefereeService::take(const aisle::MapEditResult& sample, double t_s) {
  const bool applied = sample.outcome() == EditOutcome::EDIT_APPLIED;
  const bool refused = sample.outcome() == EditOutcome::EDIT_REFUSED;
  const std::string outcome = applied   ? "applied"
                              : refused ? "refused: " + sample.detail().to_string()
                                        : "already applied";
  judge_.edit_answered({sample.edit_id().to_string(), applied, outcome, sample.revision(), t_s});
}

}  // namespace aisle::referee
