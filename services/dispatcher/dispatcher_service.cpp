#include "services/dispatcher/dispatcher_service.hpp"

#include <spdlog/spdlog.h>

#include "common/process/kept_file.hpp"
#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"

namespace aisle::dispatcher {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using std::chrono::milliseconds;

constexpr milliseconds kTick{50};
constexpr milliseconds kHealthPeriod{250};

std::vector<std::string> vehicle_ids(const scenario::Scenario& scenario) {
  std::vector<std::string> ids;
  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);
  return ids;
}

Status status_of(const aisle::NavigationStatus& sample) {
  Status status;
  status.goal_id = sample.goal_id().to_string();
  status.reason = sample.detail().to_string();
  switch (sample.phase()) {
    case NavigationPhase::PHASE_ARRIVED:
      status.phase = Status::Phase::kArrived;
      break;
    case NavigationPhase::PHASE_FAILED:
      status.phase = Status::Phase::kFailed;
      break;
    default:
      status.phase = status.goal_id.empty() ? Status::Phase::kIdle : Status::Phase::kOnTheWay;
  }
  if (sample.reason() == NavigationReason::REASON_NO_GOAL || sample.reason() == NavigationReason::REASON_NO_PLAN)
    status.phase = Status::Phase::kIdle;
  return status;
}

}  // namespace

DispatcherService::DispatcherService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id,
                                     service::Health& health, const ServiceConfig& config)
    : bus_(bus),
      health_(health),
      config_(config),
      instance_id_(instance_id),
      memory_(config.state_file.empty() ? std::nullopt : recall(config.state_file, config.scenario.name)),
      clock_(vehicle_ids(config.scenario),
             memory_ && memory_->started_at_ns ? memory_->started_at_ns : config.start_at_ns),
      dispatcher_(config.scenario.missions, config.settings, memory_ ? &memory_->missions : nullptr),
      edits_(config.scenario, memory_ ? memory_->edits_done : std::vector<std::string>{}),
      goal_stamper_(bus, instance_id, boot_id),
      edit_stamper_(bus, instance_id, boot_id),
      goals_(bus.writer<topics::Goal>()),
      map_edits_(bus.writer<topics::MapEdit>()),
      warnings_(std::chrono::seconds(10), [&bus] { return bus.now(); }) {
  listen();
  bus_.every(kTick, [this] { tick(); });
  bus_.every(kHealthPeriod, [this] { tell_health(); });
}

void DispatcherService::listen() {
  bus_.on<topics::VehicleInfo>([this](const aisle::VehicleInfo& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    const std::string agv_id = sample.agv_id().to_string();
    clock_.vehicle_heard(agv_id, bus_.now(), bus_.wall_clock_ns());
    dispatcher_.vehicle_heard(agv_id, bus_.now());
  });
  bus_.on<topics::NavigationStatus>([this](const aisle::NavigationStatus& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample);
  });
  bus_.on<topics::Goal>([this](const aisle::Goal& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample);
  });
  bus_.on<topics::MapInfo>([this](const aisle::MapInfo& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) map_id_ = sample.map_id().to_string();
  });
  bus_.on<topics::MapEditResult>([this](const aisle::MapEditResult& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample);
  });
}

void DispatcherService::take(const aisle::NavigationStatus& sample) {
  dispatcher_.status_heard(sample.agv_id().to_string(), status_of(sample), bus_.now());
}

void DispatcherService::take(const aisle::Goal& sample) {
  const bool by_another = sample.by().source_id().to_string() != instance_id_;
  if (by_another && sample.cancelled())
    dispatcher_.cancelled(sample.agv_id().to_string(), sample.goal_id().to_string());
}

void DispatcherService::take(const aisle::MapEditResult& sample) {
  const auto result = wire::decode(sample);
  if (!result) {
    health_.count("dropped_map_edit_result");
    warnings_.warn("map_edit_result", "map_edit_result: a sample was dropped: " + result.reason());
    return;
  }
  if (!edits_.answered(result->edit_id)) return;
  if (result->outcome == fleet::MapEditResult::Outcome::kRefused) {
    health_.last_error = "map edit " + result->edit_id + " refused: " + result->detail;
    health_.count("edits_refused");
    spdlog::error("{}", health_.last_error);
    return;
  }
  health_.count("edits_applied");
  spdlog::info("map edit {} is in revision {}", result->edit_id, result->revision);
}

void DispatcherService::tick() {
  const time::Stamp now = bus_.now();
  const std::vector<Order> orders = dispatcher_.step(now);
  for (const Event& event : dispatcher_.take_events()) log(event);
  for (const Order& order : orders) write(order);
  if (const auto seconds = clock_.seconds(now, bus_.wall_clock_ns())) {
    for (const fleet::MapEdit& edit : edits_.due(*seconds, map_id_, now)) {
      aisle::MapEdit sample = wire::encode(edit);
      sample.by(edit_stamper_.next());
      map_edits_.write(sample);
    }
  }
  keep_memory();
}

void DispatcherService::write(const Order& order) {
  aisle::Goal sample;
  sample.agv_id(order.agv_id);
  sample.by(goal_stamper_.next());
  sample.goal_id(order.goal_id);
  sample.pose_in_map(wire::encode(order.goal_in_map));
  sample.position_tolerance_m(order.position_tolerance_m);
  sample.yaw_tolerance_rad(order.yaw_tolerance_rad);
  sample.cancelled(false);
  goals_.write(sample);
  spdlog::info("goal {} for {}: x={:.2f} y={:.2f}", order.goal_id, order.agv_id, order.goal_in_map.x,
               order.goal_in_map.y);
}

void DispatcherService::log(const Event& event) {
  const std::string why = event.reason.empty() ? "" : ": " + event.reason;
  switch (event.kind) {
    case Event::Kind::kReached:
      spdlog::info("{} reached {}", event.agv_id, event.goal_id);
      break;
    case Event::Kind::kFailed:
      health_.last_error = event.agv_id + " did not reach " + event.goal_id + why;
      spdlog::error("{}", health_.last_error);
      break;
    case Event::Kind::kRetried:
      spdlog::warn("{} gets {} again{}", event.agv_id, event.goal_id, why);
      break;
    case Event::Kind::kCancelled:
      spdlog::warn("{} {}{}", event.agv_id, event.goal_id, why);
      break;
    case Event::Kind::kMissionDone:
      spdlog::info("{} has done its mission", event.agv_id);
      break;
    case Event::Kind::kResumed:
      spdlog::info("{} was on {}; its mission goes on from there", event.agv_id, event.goal_id);
      break;
  }
}

void DispatcherService::keep_memory() {
  if (config_.state_file.empty()) return;
  std::string text = to_text(config_.scenario.name, {dispatcher_.memory(), edits_.done(), clock_.started_at_ns()});
  if (text == kept_text_) return;
  if (process::keep_in_file(config_.state_file, text)) {
    kept_text_ = std::move(text);
  } else {
    health_.last_error =
        "cannot write " + config_.state_file.string() + "; a restart will ask the vehicles where they were";
    warnings_.warn("state_file", health_.last_error);
  }
}

void DispatcherService::tell_health() {
  health_.map_id = map_id_;
  health_.counters["goals_assigned"] = dispatcher_.assigned();
  health_.counters["goals_reached"] = dispatcher_.reached();
  health_.counters["goals_failed"] = dispatcher_.failed();
  health_.counters["missions_done"] = dispatcher_.all_done() ? 1 : 0;
  health_.waits_for.clear();
  for (const std::string& id : dispatcher_.missing()) {
    if (health_.waits_for.size() < 200)
      health_.waits_for += (health_.waits_for.empty() ? "vehicle_state of " : ", ") + id;
  }
  health_.state = health_.waits_for.empty() ? fleet::ServiceState::kReady : fleet::ServiceState::kWaiting;
}

}  // namespace aisle::dispatcher
