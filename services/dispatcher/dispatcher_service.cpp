#include "services/dispatcher/dispatcher_service.hpp"

#include <spdlog/logger.h>

#include <chrono>

#include "common/fleet/any_vehicle.hpp"
#include "common/process/kept_file.hpp"

namespace aisle::dispatcher {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{50};  // of the dispatcher: goals need not be quicker

/// All vehicles of the scenario; its second zero is when all of them are heard.
std::vector<std::string> vehicle_ids(const scenario::Scenario& scenario) {
  std::vector<std::string> ids;

  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);
  return ids;
}

/// What a vehicle's status means for its mission. Any phase between its start and its end counts as on the way; without
/// goal or plan the vehicle is idle, whatever its phase is, so that the goal is given again.
Status status_of(const fleet::NavigationStatus& navigation) {
  Status status;
  status.goal_id = navigation.goal_id;
  status.reason = navigation.detail;

  if (navigation.phase == fleet::Phase::kArrived) {
    status.phase = Status::Phase::kArrived;
  } else if (navigation.phase == fleet::Phase::kFailed) {
    status.phase = Status::Phase::kFailed;
  } else {
    status.phase = status.goal_id.empty() ? Status::Phase::kIdle : Status::Phase::kOnTheWay;
  }

  if (navigation.reason == fleet::Reason::kNoGoal || navigation.reason == fleet::Reason::kNoPlan ||
      navigation.reason == fleet::Reason::kCancelled)
    status.phase = Status::Phase::kIdle;
  return status;
}

}  // namespace

DispatcherService::DispatcherService(service::Shell& shell, const ServiceConfig& config)
    : shell_(shell),
      config_(config),
      memory_(config.state_file.empty() ? std::nullopt : recall(config.state_file, config.scenario.name)),
      clock_(vehicle_ids(config.scenario),
             memory_ && memory_->started_at_ns ? memory_->started_at_ns : config.start_at_ns),
      dispatcher_(config.scenario.missions, config.settings, memory_ ? &memory_->missions : nullptr),
      tasks_(tasks_of(config.scenario, config.settings), config.settings, memory_ ? &memory_->tasks : nullptr),
      edits_(config.scenario, memory_ ? memory_->edits_done : std::vector<std::string>{}),
      goals_(shell.outbox<topics::Goal>()),
      map_edits_(shell.outbox<topics::MapEdit>()) {
  listen();

  shell.every(kTick, [this] { tick(); });
  shell.report([this](service::Health& health) { report(health); });
}

void DispatcherService::listen() {
  // A vehicle that is heard, and what it says about its goal.
  shell_.inbox<topics::VehicleInfo>([this](const fleet::Vehicle& vehicle) {
    clock_.vehicle_heard(vehicle.id, shell_.now(), shell_.wall_clock_ns());
    dispatcher_.vehicle_heard(vehicle.id, shell_.now());
    tasks_.vehicle_heard(vehicle.id, vehicle.limits.max_speed_mps, shell_.now());
  });

  shell_.inbox<topics::VehicleState>([this](const fleet::VehicleState& state) {
    tasks_.place_heard(state.agv_id, state.motion.base_in_map.position(), shell_.now());
  });

  shell_.inbox<topics::NavigationStatus>([this](const fleet::NavigationStatus& status) {
    dispatcher_.status_heard(status.agv_id, status_of(status), shell_.now());
    tasks_.status_heard(status.agv_id, status_of(status), status.distance_left_m, shell_.now());
  });

  shell_.inbox<topics::Goal>([this](const fleet::Goal& goal, const service::Sender& from) {
    // Goals of this process come back to it; only those of people and other programs matter.
    if (from.by.source_id != shell_.instance_id()) take(goal);
  });

  // Edits name the map that is served, and are repeated until they are answered.
  shell_.inbox<topics::MapInfo>([this](const grid::MapSummary& summary) { map_id_ = summary.map_id; });
  shell_.inbox<topics::MapEditResult>([this](const fleet::MapEditResult& result) { take(result); });
}

void DispatcherService::take(const fleet::Goal& goal) {
  if (goal.is_cancelled) {
    dispatcher_.cancelled(goal.agv_id, goal.id);
    tasks_.cancelled(goal.id);
  } else if (goal.agv_id == fleet::kAnyVehicle) {
    tasks_.add({goal.id, {{goal.id, goal.pose_in_map, goal.position_tolerance_m, goal.yaw_tolerance_rad}}},
               shell_.now());
  }
}

void DispatcherService::take(const fleet::MapEditResult& result) {
  if (!edits_.answered(result.edit_id)) return;

  if (result.outcome == fleet::MapEditResult::Outcome::kRefused) {
    shell_.health().last_error = "map edit " + result.edit_id + " refused: " + result.detail;
    shell_.count("edits_refused");
    shell_.log().error("{}", shell_.health().last_error);

    return;
  }

  shell_.count("edits_applied");
  shell_.log().info("map edit {} is in revision {}", result.edit_id, result.revision);
}

void DispatcherService::tick() {
  const time::Stamp now = shell_.now();
  // One step of the missions, then of the tasks; events go to the log, orders to the vehicles.
  const std::vector<Order> orders = dispatcher_.step(now);
  for (const Event& event : dispatcher_.take_events()) log(event);
  for (const Order& order : orders) write(order);

  const std::vector<Order> task_orders = tasks_.step(dispatcher_.engaged(), now);
  for (const Event& event : tasks_.take_events()) log(event);
  for (const Order& order : task_orders) write(order);

  // Map edits of the scenario, once its second zero is known.
  if (const auto seconds = clock_.seconds(now, shell_.wall_clock_ns())) {
    for (const fleet::MapEdit& edit : edits_.due(*seconds, map_id_, now)) map_edits_.write(edit);
  }

  keep_memory();
}

void DispatcherService::write(const Order& order) {
  fleet::Goal goal;
  goal.agv_id = order.agv_id;
  goal.id = order.goal_id;
  goal.pose_in_map = order.goal_in_map;
  goal.position_tolerance_m = order.position_tolerance_m;
  goal.yaw_tolerance_rad = order.yaw_tolerance_rad;
  goal.is_cancelled = order.is_cancelled;

  goals_.write(goal);

  shell_.log().info("goal {} for {}{}: x={:.2f} y={:.2f}", order.goal_id, order.agv_id,
                    order.is_cancelled ? " cancelled" : "", order.goal_in_map.x, order.goal_in_map.y);
}

void DispatcherService::log(const Event& event) {
  const std::string why = event.reason.empty() ? "" : ": " + event.reason;
  switch (event.kind) {
    case Event::Kind::kReached:
      shell_.log().info("{} reached {}", event.agv_id, event.goal_id);
      break;

    case Event::Kind::kFailed:
      shell_.health().last_error = event.agv_id + " did not reach " + event.goal_id + why;
      shell_.log().error("{}", shell_.health().last_error);
      break;

    case Event::Kind::kRetried:
      shell_.log().warn("{} gets {} again{}", event.agv_id, event.goal_id, why);
      break;

    case Event::Kind::kCancelled:
      shell_.log().warn("{} {}{}", event.agv_id, event.goal_id, why);
      break;

    case Event::Kind::kMissionDone:
      shell_.log().info("{} has done its mission", event.agv_id);
      break;

    case Event::Kind::kResumed:
      shell_.log().info("{} was on {}; its mission goes on from there", event.agv_id, event.goal_id);
      break;

    case Event::Kind::kGiven:
      shell_.log().info("{} serves {}", event.agv_id, event.goal_id);
      break;

    case Event::Kind::kTakenBack:
      shell_.log().warn("{} is taken from {}{}", event.goal_id, event.agv_id, why);
      break;
  }
}

void DispatcherService::keep_memory() {
  if (config_.state_file.empty()) return;

  // Written only when something changed: this is called twenty times a second.
  std::string text =
      to_text(config_.scenario.name, {dispatcher_.memory(), tasks_.memory(), edits_.done(), clock_.started_at_ns()});
  if (text == kept_text_) return;

  if (process::keep_in_file(config_.state_file, text)) {
    kept_text_ = std::move(text);
  } else {
    shell_.health().last_error =
        "cannot write " + config_.state_file.string() + "; a restart will ask the vehicles where they were";
    shell_.warn("state_file", shell_.health().last_error);
  }
}

void DispatcherService::report(service::Health& health) const {
  health.map_id = map_id_;

  health.counters["goals_assigned"] = dispatcher_.assigned() + tasks_.assigned();
  health.counters["goals_reached"] = dispatcher_.reached() + tasks_.reached();
  health.counters["goals_failed"] = dispatcher_.failed() + tasks_.failed();
  health.counters["missions_done"] = dispatcher_.all_done() && tasks_.all_done() ? 1 : 0;

  for (const std::string& id : dispatcher_.missing())
    health.wait_for(health.waits_for.empty() ? "vehicle_state of " + id : id);
}

}  // namespace aisle::dispatcher
