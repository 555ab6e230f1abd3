#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "common/scenario/scenario_clock.hpp"
#include "common/service/shell.hpp"
#include "services/fake-world/core/world.hpp"

namespace aisle::fake_world {

/// What the process takes from its command line.
struct ServiceConfig {
  scenario::Scenario scenario;
  std::uint64_t seed{1};

  /// Second zero of the scenario, nanoseconds since the Unix epoch; none: when all vehicles are heard.
  std::optional<std::int64_t> start_at_ns;

  std::filesystem::path state_file;  // empty: nothing is kept

  /// Of each recording, where they are read already; none: read from the scenario's files.
  std::optional<std::vector<std::vector<RecordedPerson>>> people{};
};

/// Shows the things of a scenario on `world_obstacle`, 50 times a second, from second zero on, and reads there where
/// the vehicles are: courteous people stop for them. A restarted process goes on where its state file was written.
class FakeWorldService {
 public:
  /// @throws config::BadInput for a recording that cannot be read
  FakeWorldService(service::Shell& shell, const ServiceConfig& config);
  FakeWorldService(const FakeWorldService&) = delete;
  FakeWorldService& operator=(const FakeWorldService&) = delete;

 private:
  /// Remembers the body of a vehicle; things of this service are ignored.
  void take(const fleet::Obstacle& obstacle);

  /// Moves the world on to this second and writes what is there.
  void tick();

  /// Writes all things, and disposes of the instances of things that went.
  void publish();

  /// Writes the state file, ten times a second.
  void keep_memory();

  /// Counters, and the vehicles without which second zero is unknown.
  void report(service::Health& health) const;

  service::Shell& shell_;
  ServiceConfig config_;
  std::string run_;  // scenario and seed: names the state file's content
  std::optional<Memory> memory_;

  scenario::ScenarioClock clock_;
  World world_;
  std::map<std::string, geometry::Body> vehicles_;
  service::Outbox<topics::WorldObstacle> obstacles_;
};

}  // namespace aisle::fake_world
