#include "services/fake-world/fake_world_service.hpp"

#include <spdlog/spdlog.h>

#include "common/wire/vehicle.hpp"
#include "services/fake-world/world_memory.hpp"

namespace aisle::fake_world {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using std::chrono::milliseconds;

constexpr milliseconds kTick{20};
constexpr milliseconds kKeepPeriod{100};
constexpr milliseconds kHealthPeriod{250};

std::vector<std::string> vehicle_ids(const scenario::Scenario& scenario) {
  std::vector<std::string> ids;
  for (const scenario::Vehicle& vehicle : scenario.vehicles) ids.push_back(vehicle.id);
  return ids;
}

std::vector<std::vector<RecordedPerson>> read_recordings(const scenario::Scenario& scenario) {
  std::vector<std::vector<RecordedPerson>> people;
  for (const scenario::Recording& recording : scenario.recordings) people.push_back(read_recording(recording));
  return people;
}

/// A world that was away stood still meanwhile: it goes on at the second where it was, so that nothing jumps.
std::optional<std::int64_t> second_zero(const ServiceConfig& config, const std::optional<Memory>& memory,
                                        std::int64_t wall_clock_ns) {
  if (!memory) return config.start_at_ns;
  spdlog::info("goes on at second {:.1f} of the scenario", memory->seconds);
  return wall_clock_ns - time::from_seconds(memory->seconds).count();
}

aisle::WorldObstacle encode(const Thing& thing) {
  fleet::Obstacle obstacle;
  obstacle.id = thing.id;
  obstacle.kind = thing.kind == Kind::kPerson ? fleet::Obstacle::Kind::kPerson : fleet::Obstacle::Kind::kBlock;
  obstacle.base_in_map = thing.body.base_in_map;
  obstacle.footprint = {thing.body.shape, thing.body.radius_m, thing.body.length_m, thing.body.width_m, 0.0};
  obstacle.velocity_in_map = thing.velocity_in_map;
  return wire::encode(obstacle);
}

}  // namespace

FakeWorldService::FakeWorldService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id,
                                   service::Health& health, const ServiceConfig& config)
    : bus_(bus),
      health_(health),
      config_(config),
      run_(config.scenario.name + "/" + std::to_string(config.seed)),
      memory_(config.state_file.empty() ? std::nullopt : recall(config.state_file, run_)),
      clock_(vehicle_ids(config.scenario), second_zero(config, memory_, bus.wall_clock_ns())),
      world_(config.scenario, read_recordings(config.scenario), config.seed, memory_ ? &*memory_ : nullptr),
      stamper_(bus, instance_id, boot_id),
      obstacles_(bus.writer<topics::WorldObstacle>()),
      warnings_(std::chrono::seconds(10), [&bus] { return bus.now(); }) {
  bus_.on<topics::WorldObstacle>(
      [this](const aisle::WorldObstacle& sample, const SampleInfo& info) { take(sample, info); });
  bus_.every(kTick, [this] { tick(); });
  bus_.every(kHealthPeriod, [this] { tell_health(); });
  if (!config_.state_file.empty()) bus_.every(kKeepPeriod, [this] { keep_memory(); });
}

void FakeWorldService::take(const aisle::WorldObstacle& sample, const SampleInfo& info) {
  if (info.kind != SampleKind::kData || sample.kind() != BodyKind::BODY_VEHICLE)
    return;  // a silent vehicle still stands there
  const auto vehicle = wire::decode(sample);
  if (!vehicle) {
    health_.count("dropped_world_obstacle");
    warnings_.warn("world_obstacle", "world_obstacle: a sample was dropped: " + vehicle.reason());
    return;
  }
  constexpr std::size_t kMostVehicles = 1000;
  if (vehicles_.size() < kMostVehicles || vehicles_.count(vehicle->id) > 0) vehicles_[vehicle->id] = vehicle->body();
  clock_.vehicle_heard(vehicle->id, bus_.now(), bus_.wall_clock_ns());
}

void FakeWorldService::tick() {
  const std::optional<double> seconds = clock_.seconds(bus_.now(), bus_.wall_clock_ns());
  if (!seconds || *seconds < 0.0) return;
  std::vector<geometry::Body> vehicles;
  for (const auto& [id, body] : vehicles_) vehicles.push_back(body);
  world_.advance_to(*seconds, vehicles);
  publish();
}

void FakeWorldService::publish() {
  for (const Thing& thing : world_.things()) {
    aisle::WorldObstacle sample = encode(thing);
    sample.by(stamper_.next());
    obstacles_.write(sample);
  }
  for (const std::string& id : world_.gone()) {
    aisle::WorldObstacle sample;
    sample.obstacle_id(id);
    obstacles_.dispose(sample);
  }
}

void FakeWorldService::keep_memory() {
  if (!clock_.started_at_ns() || keep(config_.state_file, run_, world_.memory())) return;
  health_.last_error = "cannot write " + config_.state_file.string() + "; a restart will begin anew";
  warnings_.warn("state_file", health_.last_error);
}

void FakeWorldService::tell_health() {
  health_.counters["things"] = world_.things().size();
  const bool runs = clock_.started_at_ns().has_value();
  health_.state = runs ? fleet::ServiceState::kReady : fleet::ServiceState::kWaiting;
  health_.waits_for.clear();
  if (runs) return;
  for (const std::string& id : clock_.missing()) {
    if (health_.waits_for.size() < 200) health_.waits_for += (health_.waits_for.empty() ? "vehicles " : ", ") + id;
  }
}

}  // namespace aisle::fake_world
