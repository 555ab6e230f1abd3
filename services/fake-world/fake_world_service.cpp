#include "services/fake-world/fake_world_service.hpp"

#include <spdlog/logger.h>

#include <chrono>

#include "services/fake-world/world_memory.hpp"

namespace aisle::fake_world {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{20};         // between two positions of a thing
constexpr milliseconds kKeepPeriod{100};  // between two writes of the state file

/// All vehicles of the scenario; its second zero is when all of them are heard.
std::vector<std::string> vehicle_ids(const scenario::Scenario& scenario) {
  std::vector<std::string> ids;

  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);
  return ids;
}

/// The people of each recording, in the scenario's order.
std::vector<std::vector<RecordedPerson>> read_recordings(const scenario::Scenario& scenario) {
  std::vector<std::vector<RecordedPerson>> people;

  for (const scenario::Recording& recording : scenario.recordings) people.push_back(read_recording(recording));
  return people;
}

/// A world that was away stood still meanwhile: it goes on at the second where it was, so that nothing jumps.
std::optional<std::int64_t> second_zero(const service::Shell& shell, const ServiceConfig& config,
                                        const std::optional<Memory>& memory) {
  if (!memory) return config.start_at_ns;

  shell.log().info("goes on at second {:.1f} of the scenario", memory->seconds);

  return shell.wall_clock_ns() - time::from_seconds(memory->seconds).count();
}

/// A thing as it is written to `world_obstacle`.
fleet::Obstacle obstacle_of(const Thing& thing) {
  fleet::Obstacle obstacle;
  obstacle.id = thing.id;
  obstacle.kind = thing.kind == Kind::kPerson ? fleet::Obstacle::Kind::kPerson : fleet::Obstacle::Kind::kBlock;
  obstacle.base_in_map = thing.body.base_in_map;
  obstacle.footprint = {thing.body.shape, thing.body.radius_m, thing.body.length_m, thing.body.width_m, 0.0};
  obstacle.velocity_in_map = thing.velocity_in_map;

  return obstacle;
}

}  // namespace

FakeWorldService::FakeWorldService(service::Shell& shell, const ServiceConfig& config)
    : shell_(shell),
      config_(config),
      run_(config.scenario.name + "/" + std::to_string(config.seed)),
      memory_(config.state_file.empty() ? std::nullopt : recall(config.state_file, run_)),
      clock_(vehicle_ids(config.scenario), second_zero(shell, config, memory_)),
      world_(config.scenario, config.people ? *config.people : read_recordings(config.scenario), config.seed,
             memory_ ? &*memory_ : nullptr),
      obstacles_(shell.outbox<topics::WorldObstacle>()) {
  shell.inbox<topics::WorldObstacle>([this](const fleet::Obstacle& obstacle) { take(obstacle); });

  shell.every(kTick, [this] { tick(); });
  shell.report([this](service::Health& health) { report(health); });
  if (!config_.state_file.empty()) shell.every(kKeepPeriod, [this] { keep_memory(); });
}

void FakeWorldService::take(const fleet::Obstacle& obstacle) {
  if (obstacle.kind != fleet::Obstacle::Kind::kVehicle) return;  // our own things

  // Bounded, so that a sender of ever new ids cannot fill the memory.
  constexpr std::size_t kMostVehicles = 1000;

  if (vehicles_.size() < kMostVehicles || vehicles_.count(obstacle.id) > 0) vehicles_[obstacle.id] = obstacle.body();

  clock_.vehicle_heard(obstacle.id, shell_.now(), shell_.wall_clock_ns());
}

void FakeWorldService::tick() {
  const std::optional<double> seconds = clock_.seconds(shell_.now(), shell_.wall_clock_ns());
  if (!seconds || *seconds < 0.0) return;

  // Courteous people look where the vehicles are.
  std::vector<geometry::Body> vehicles;
  for (const auto& [id, body] : vehicles_) vehicles.push_back(body);

  world_.advance_to(*seconds, vehicles);
  publish();
}

void FakeWorldService::publish() {
  for (const Thing& thing : world_.things()) obstacles_.write(obstacle_of(thing));
  for (const std::string& id : world_.gone()) obstacles_.dispose(id);
}

void FakeWorldService::keep_memory() {
  if (!clock_.started_at_ns() || keep(config_.state_file, run_, world_.memory())) return;

  shell_.health().last_error = "cannot write " + config_.state_file.string() + "; a restart will begin anew";
  shell_.warn("state_file", shell_.health().last_error);
}

void FakeWorldService::report(service::Health& health) const {
  health.counters["things"] = world_.things().size();

  // Until second zero is known: which vehicles are missing.
  if (clock_.started_at_ns()) return;

  for (const std::string& id : clock_.missing()) health.wait_for(health.waits_for.empty() ? "vehicles " + id : id);
  if (health.waits_for.empty()) health.wait_for("vehicles");  // the scenario names none, and no start was given
}

}  // namespace aisle::fake_world
