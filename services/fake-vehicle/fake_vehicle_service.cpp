#include "services/fake-vehicle/fake_vehicle_service.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "common/scenario/variation.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/service.hpp"
#include "common/wire/vehicle.hpp"
#include "services/fake-vehicle/core/lidar.hpp"

namespace aisle::fake_vehicle {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using std::chrono::milliseconds;

constexpr milliseconds kTick{20};
constexpr milliseconds kKeepPeriod{100};
constexpr milliseconds kHealthPeriod{250};

VehicleMemory memory_of(const ServiceConfig& config) {
  if (!config.state_file.empty()) {
    if (const auto memory = recall(config.state_file, config.run)) {
      spdlog::info("goes on at x={:.2f} y={:.2f}, where it was before", memory->base_in_map.x, memory->base_in_map.y);
      return *memory;
    }
  }
  return {config.run, config.start_in_map, 0};
}

}  // namespace

FakeVehicleService::FakeVehicleService(bus::Bus& bus, const std::string& agv_id, const std::string& instance_id,
                                       std::uint64_t boot_id, service::Health& health, const ServiceConfig& config)
    : bus_(bus),
      agv_id_(agv_id),
      health_(health),
      config_(config),
      map_(bus, instance_id, {{}, false, 0.0, milliseconds(300)}),
      memory_(memory_of(config)),
      authority_(agv_id, memory_.accepted_epoch),
      vehicle_(config.vehicle, memory_.base_in_map),
      bodies_(agv_id),
      duplicates_(boot_id),
      random_(scenario::random_for(config.seed, agv_id + "/noise")),
      info_stamper_(bus, instance_id, boot_id),
      state_stamper_(bus, instance_id, boot_id),
      scan_stamper_(bus, instance_id, boot_id),
      truth_stamper_(bus, instance_id, boot_id),
      infos_(bus.writer<topics::VehicleInfo>()),
      states_(bus.writer<topics::VehicleState>()),
      scans_(bus.writer<topics::Scan>()),
      truths_(bus.writer<topics::WorldObstacle>()),
      warnings_(std::chrono::seconds(10), [&bus] { return bus.now(); }),
      started_(bus.now()) {
  listen();
  bus_.every(kTick, [this] { tick(); });
  bus_.every(kHealthPeriod, [this] { tell_health(bus_.now()); });
  if (!config_.state_file.empty()) bus_.every(kKeepPeriod, [this] { keep_memory(); });
}

void FakeVehicleService::listen() {
  bus_.on<topics::VelocityCommand>(
      [this](const aisle::VelocityCommand& sample, const SampleInfo& info) { take(sample, info); });
  bus_.on<topics::WorldObstacle>(
      [this](const aisle::WorldObstacle& sample, const SampleInfo& info) { take(sample, info); });
  bus_.on<topics::ServiceHealth>([this](const aisle::ServiceHealth& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    const auto health = accepted("service_health", wire::decode(sample));
    if (health && is_this_vehicle(*health)) duplicates_.heard(wire::origin_of(sample).boot_id, bus_.now());
  });
}

bool FakeVehicleService::is_this_vehicle(const fleet::ServiceHealth& health) const {
  return health.service == "fake-vehicle" && health.agv_id == agv_id_ && health.state != fleet::ServiceState::kStopping;
}

template <class T>
std::optional<T> FakeVehicleService::accepted(const char* topic, wire::Decoded<T> decoded) {
  if (decoded) return *std::move(decoded);
  health_.count(std::string("dropped_") + topic);
  warnings_.warn(topic, std::string(topic) + ": a sample was dropped: " + decoded.reason());
  return std::nullopt;
}

void FakeVehicleService::take(const aisle::VelocityCommand& sample, const SampleInfo& info) {
  if (info.kind != SampleKind::kData || sample.agv_id().to_string() != agv_id_ || yields_) return;
  const auto command = accepted("velocity_command", wire::decode(sample));
  if (!command) return;
  const fleet::Origin by = wire::origin_of(sample);
  const fleet::CommandVerdict verdict = authority_.judge(*command, by);
  if (verdict != fleet::CommandVerdict::kAccepted) {
    health_.count(std::string("refused_") + name(verdict));
    warnings_.warn(name(verdict), fmt::format("velocity_command refused: {} (source {}, epoch {}, accepted epoch {})",
                                              name(verdict), by.source_id, by.epoch, authority_.accepted_epoch()));
    return;
  }
  if (!map_.has_map()) return;  // cannot tell where its walls are
  command_ = fleet::CommandInForce{command->agv_id, by, command->plan_id};
  vehicle_.command(command->twist, info.arrived);
}

void FakeVehicleService::take(const aisle::WorldObstacle& sample, const SampleInfo& info) {
  if (info.kind == SampleKind::kDisposed) bodies_.gone(sample.obstacle_id().to_string());
  if (info.kind != SampleKind::kData) return;
  const auto obstacle = accepted("world_obstacle", wire::decode(sample));
  if (!obstacle) return;
  bodies_.seen(obstacle->id, obstacle->body(), obstacle->kind == fleet::Obstacle::Kind::kVehicle,
               wire::origin_of(sample).boot_id, bus_.now());
}

bool FakeVehicleService::may_act(time::Stamp now) {
  const bool yields = duplicates_.must_yield(now);
  if (yields != yields_) {
    if (yields) {
      spdlog::error(
          "hold=duplicate_id: another process (boot {}) is {} already; this one stands and stays silent until it is "
          "gone",
          duplicates_.other_boot_id(), agv_id_);
    } else {
      spdlog::info("{} is free again", agv_id_);
    }
  }
  yields_ = yields;
  if (!introduced_ && duplicates_.is_taken(now)) return false;
  return !yields_ && now - started_ >= kListen;
}

void FakeVehicleService::tick() {
  const time::Stamp now = bus_.now();
  if (!may_act(now)) {
    if (introduced_ && map_.has_map())
      vehicle_.advance_to(now, {map_.grid(), bodies_.bodies()});  // brakes: nobody commands it any more
    return;
  }
  if (!introduced_) {
    const Parameters& vehicle = config_.vehicle;
    aisle::VehicleInfo info = wire::encode(fleet::Vehicle{agv_id_, vehicle.footprint(), vehicle.limits,
                                                          vehicle.lidar.range_max_m, vehicle.command_timeout_s});
    info.by(info_stamper_.next());
    introduced_ = infos_.write(info);
  }
  bodies_.forget_old_world(now);
  if (map_.has_map()) vehicle_.advance_to(now, {map_.grid(), bodies_.bodies()});
  publish();
  if (now < next_scan_ || !map_.has_map()) return;
  const time::Stamp period = time::from_seconds(config_.vehicle.lidar.period_s);
  next_scan_ = now - next_scan_ > period ? now + period - kTick / 2 : next_scan_ + period;
  publish_scan();
}

/// As the vehicle believes it: each call draws a new error of its pose.
fleet::VehicleState FakeVehicleService::state() {
  fleet::VehicleState state;
  state.agv_id = agv_id_;
  state.motion = {with_noise(vehicle_.base_in_map(), config_.vehicle, random_), vehicle_.twist(),
                  vehicle_.steering_rad()};
  state.hold = vehicle_.hold();
  state.command = command_;
  state.accepted_epoch = authority_.accepted_epoch();
  state.refused_commands = authority_.refused();
  return state;
}

void FakeVehicleService::publish() {
  aisle::VehicleState state_sample = wire::encode(state());
  state_sample.by(state_stamper_.next());
  states_.write(state_sample);

  const geometry::Pose2& base = vehicle_.base_in_map();
  const geometry::Twist2& twist = vehicle_.twist();
  fleet::Obstacle truth;
  truth.id = agv_id_;
  truth.kind = fleet::Obstacle::Kind::kVehicle;
  truth.base_in_map = base;
  truth.footprint = config_.vehicle.footprint();
  truth.velocity_in_map = geometry::to_map({0.0, 0.0, base.yaw}, {twist.linear_mps, twist.sideways_mps});
  aisle::WorldObstacle sample = wire::encode(truth);
  sample.by(truth_stamper_.next());
  truths_.write(sample);
}

void FakeVehicleService::publish_scan() {
  const LidarParameters& lidar = config_.vehicle.lidar;
  fleet::Scan turn;
  turn.ranges_m = scan({map_.grid(), bodies_.bodies()}, vehicle_.base_in_map(), lidar, random_);
  const fleet::Motion motion = state().motion;
  turn.agv_id = agv_id_;
  turn.base_in_map = motion.base_in_map;
  turn.position_sigma_m = config_.vehicle.pose_noise_m;
  turn.yaw_sigma_rad = config_.vehicle.yaw_noise_rad;
  turn.twist = motion.twist;
  turn.angle_step_rad = 2.0 * geometry::kPi / static_cast<double>(turn.ranges_m.size());
  turn.range_min_m = lidar.range_min_m;
  turn.range_max_m = lidar.range_max_m;
  aisle::Scan sample = wire::encode(turn);
  sample.by(scan_stamper_.next());
  scans_.write(sample);
}

void FakeVehicleService::keep_memory() {
  if (yields_ || !introduced_) return;
  if (!keep(config_.state_file, {config_.run, vehicle_.base_in_map(), authority_.accepted_epoch()})) {
    health_.last_error = "cannot write " + config_.state_file.string() + "; a restart will begin at the start";
    warnings_.warn("state_file", health_.last_error);
  }
}

void FakeVehicleService::tell_health(time::Stamp now) {
  health_.map_id = map_.map_id();
  health_.map_revision = map_.revision();
  health_.map_hash = map_.hash();
  health_.counters["contacts"] = vehicle_.contacts();
  if (duplicates_.is_duplicate(now)) {
    health_.state = fleet::ServiceState::kDegraded;
    health_.last_error =
        fmt::format("two processes are {}: boot {} and this one, which {}", agv_id_, duplicates_.other_boot_id(),
                    yields_ ? "came later, stands and stays silent (hold: duplicate id)" : "was first and goes on");
    health_.waits_for = yields_ ? "the other " + agv_id_ + " to be gone" : "";
    return;
  }
  health_.waits_for = map_.has_map() ? "" : "map_info";
  health_.state = map_.has_map() ? fleet::ServiceState::kReady : fleet::ServiceState::kWaiting;
}

}  // namespace aisle::fake_vehicle
