#include "services/fake-vehicle/fake_vehicle_service.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <chrono>

#include "common/scenario/variation.hpp"
#include "services/fake-vehicle/core/lidar.hpp"

namespace aisle::fake_vehicle {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{20};         // between two states
constexpr milliseconds kKeepPeriod{100};  // between two writes of the state file

/// What the state file holds of this run; without it the start.
VehicleMemory memory_of(const service::Shell& shell, const ServiceConfig& config) {
  if (!config.state_file.empty()) {
    if (const auto memory = recall(config.state_file, config.run)) {
      shell.log().info("goes on at x={:.2f} y={:.2f}, where it was before", memory->base_in_map.x,
                       memory->base_in_map.y);
      return *memory;
    }
  }

  return {config.run, config.start_in_map, 0};
}

}  // namespace

FakeVehicleService::FakeVehicleService(service::Shell& shell, const ServiceConfig& config)
    : shell_(shell),
      agv_id_(shell.agv_id()),
      config_(config),
      map_(shell.map({{}, false, 0.0, milliseconds(300)})),
      memory_(memory_of(shell, config)),
      authority_(agv_id_, memory_.accepted_epoch),
      vehicle_(config.vehicle, memory_.base_in_map),
      bodies_(agv_id_),
      duplicates_(shell.boot_id()),
      random_(scenario::random_for(config.seed, agv_id_ + "/noise")),
      infos_(shell.outbox<topics::VehicleInfo>()),
      states_(shell.outbox<topics::VehicleState>()),
      scans_(shell.outbox<topics::Scan>()),
      truths_(shell.outbox<topics::WorldObstacle>()),
      started_(shell.now()) {
  listen();

  shell.every(kTick, [this] { tick(); });
  shell.report([this](service::Health& health) { report(health); });
  if (!config_.state_file.empty()) shell.every(kKeepPeriod, [this] { keep_memory(); });
}

void FakeVehicleService::listen() {
  shell_
      .inbox<topics::VelocityCommand>(
          [this](const fleet::VelocityCommand& command, const service::Sender& from) { take(command, from); })
      .on_refused([this](const std::string& agv_id, const std::string&) {
        if (agv_id == agv_id_ && !yields_) shell_.count(std::string("refused_") + name(authority_.refuse_unread()));
      });

  // What cannot be decoded still counts as a refused command when it names this vehicle.
  shell_
      .inbox<topics::WorldObstacle>([this](const fleet::Obstacle& obstacle, const service::Sender& from) {
        bodies_.seen(obstacle.id, obstacle.body(), obstacle.kind == fleet::Obstacle::Kind::kVehicle, from.by.boot_id,

                     shell_.now());
      })
      .on_gone([this](const std::string& id, service::End how) {
        if (how == service::End::kDisposed) bodies_.gone(id);  // what falls silent still stands there
      });

  shell_.inbox<topics::ServiceHealth>([this](const fleet::ServiceHealth& health, const service::Sender& from) {
    if (is_this_vehicle(health)) duplicates_.heard(from.by.boot_id, shell_.now());
  });
}

bool FakeVehicleService::is_this_vehicle(const fleet::ServiceHealth& health) const {
  return health.service == "fake-vehicle" && health.agv_id == agv_id_ && health.state != fleet::ServiceState::kStopping;
}

void FakeVehicleService::take(const fleet::VelocityCommand& command, const service::Sender& from) {
  if (command.agv_id != agv_id_ || yields_) return;

  // May this source command the vehicle? The answer raises the accepted epoch or counts a refusal.
  const fleet::Origin& by = from.by;
  const fleet::CommandVerdict verdict = authority_.judge(command, by);

  if (verdict != fleet::CommandVerdict::kAccepted) {
    shell_.count(std::string("refused_") + name(verdict));
    shell_.warn(name(verdict), fmt::format("velocity_command refused: {} (source {}, epoch {}, accepted epoch {})",
                                           name(verdict), by.source_id, by.epoch, authority_.accepted_epoch()));
    return;
  }

  if (!map_.has_map()) return;  // cannot tell where its walls are

  command_ = fleet::CommandInForce{command.agv_id, by, command.plan_id};
  vehicle_.command(command.twist, from.arrived);
}

bool FakeVehicleService::may_act(time::Stamp now) {
  const bool yields = duplicates_.must_yield(now);
  if (yields != yields_) {
    if (yields) {
      shell_.log().error(
          "hold=duplicate_id: another process (boot {}) is {} already; this one stands and stays silent until it is "
          "gone",
          duplicates_.other_boot_id(), agv_id_);
    } else {
      shell_.log().info("{} is free again", agv_id_);
    }
  }

  // A newcomer keeps silent while it listens, and after one word from an earlier process of the same name.
  yields_ = yields;
  if (!introduced_ && duplicates_.is_taken(now)) return false;
  return !yields_ && now - started_ >= kListen;
}

void FakeVehicleService::tick() {
  const time::Stamp now = shell_.now();
  if (config_.hindrance != nullptr) vehicle_.hinder(*config_.hindrance);
  if (!may_act(now)) {
    if (introduced_ && map_.has_map())
      vehicle_.advance_to(now, {map_.grid(), bodies_.bodies()});  // brakes: nobody commands it any more
    return;
  }

  if (!introduced_) {
    const Parameters& vehicle = config_.vehicle;
    introduced_ = infos_.write(
        {agv_id_, vehicle.footprint(), vehicle.limits, vehicle.lidar.range_max_m, vehicle.command_timeout_s});
  }

  // Without a map it stands: nothing is known of its walls.
  bodies_.forget_old_world(now);
  if (map_.has_map()) vehicle_.advance_to(now, {map_.grid(), bodies_.bodies()});

  publish();

  // Scans keep their period on the clock; after a gap longer than one period they begin anew.
  if (now < next_scan_ || !map_.has_map()) return;
  const time::Stamp period = time::from_seconds(config_.vehicle.lidar.period_s);

  next_scan_ = now - next_scan_ > period ? now + period - kTick / 2 : next_scan_ + period;

  publish_scan();
}

/// The vehicle's state as it is published: each call draws a new error of the pose.
fleet::VehicleState FakeVehicleService::state() {
  fleet::VehicleState state;
  state.agv_id = agv_id_;
  state.motion = {with_noise(vehicle_.base_in_map(), config_.vehicle, random_), vehicle_.twist(),
                  vehicle_.steering_rad()};

  // What it obeys: the command in force, the epoch, and how many commands it refused.
  state.hold = vehicle_.hold();
  state.command = command_;
  state.accepted_epoch = authority_.accepted_epoch();
  state.refused_commands = authority_.refused();

  return state;
}

void FakeVehicleService::publish() {
  states_.write(state());

  // The truth goes to the simulators only: the others' bodies for collisions and scans.
  const geometry::Pose2& base = vehicle_.base_in_map();
  const geometry::Twist2& twist = vehicle_.twist();

  fleet::Obstacle truth;
  truth.id = agv_id_;
  truth.kind = fleet::Obstacle::Kind::kVehicle;
  truth.base_in_map = base;
  truth.footprint = config_.vehicle.footprint();
  truth.velocity_in_map = geometry::to_map({0.0, 0.0, base.yaw}, {twist.linear_mps, twist.sideways_mps});

  truths_.write(truth);
}

void FakeVehicleService::publish_scan() {
  const LidarParameters& lidar = config_.vehicle.lidar;
  fleet::Scan turn;
  turn.ranges_m = scan({map_.grid(), bodies_.bodies()}, vehicle_.base_in_map(), lidar, random_);

  // Ranges are true to where the vehicle is; the pose that goes with them is what it believes.
  const fleet::Motion motion = state().motion;
  turn.agv_id = agv_id_;
  turn.base_in_map = motion.base_in_map;
  turn.position_sigma_m = config_.vehicle.pose_noise_m;
  turn.yaw_sigma_rad = config_.vehicle.yaw_noise_rad;
  turn.twist = motion.twist;

  turn.angle_step_rad = 2.0 * geometry::kPi / static_cast<double>(turn.ranges_m.size());
  turn.range_min_m = lidar.range_min_m;
  turn.range_max_m = lidar.range_max_m;

  scans_.write(turn);
}

void FakeVehicleService::keep_memory() {
  if (yields_ || !introduced_) return;

  if (!keep(config_.state_file, {config_.run, vehicle_.base_in_map(), authority_.accepted_epoch()})) {
    shell_.health().last_error = "cannot write " + config_.state_file.string() + "; a restart will begin at the start";
    shell_.warn("state_file", shell_.health().last_error);
  }
}

void FakeVehicleService::report(service::Health& health) const {
  health.counters["contacts"] = vehicle_.contacts();

  if (!duplicates_.is_duplicate(shell_.now())) {
    if (!map_.has_map()) health.wait_for("map_info");
    return;
  }

  // A duplicate is a fault of the site: both processes say so.
  health.is_degraded = true;
  health.last_error =
      fmt::format("two processes are {}: boot {} and this one, which {}", agv_id_, duplicates_.other_boot_id(),
                  yields_ ? "came later, stands and stays silent (hold: duplicate id)" : "was first and goes on");
  if (yields_) health.wait_for("the other " + agv_id_ + " to be gone");
}

}  // namespace aisle::fake_vehicle
