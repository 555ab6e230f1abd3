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

struct ServiceConfig {
  scenario::Scenario scenario;
  std::uint64_t seed{1};
  std::optional<std::int64_t>
      start_at_ns;                   // second zero of the scenario, Unix epoch; none: when all vehicles are heard
  std::filesystem::path state_file;  // empty: nothing is kept
};

/// Shows the things of a scenario on `world_obstacle`, 50 times a second, from second zero on.
class FakeWorldService {
 public:
  /// @throws config::BadInput for a recording that cannot be read
  FakeWorldService(service::Shell& shell, const ServiceConfig& config);
  FakeWorldService(const FakeWorldService&) = delete;
  FakeWorldService& operator=(const FakeWorldService&) = delete;

 private:
  void take(const fleet::Obstacle& obstacle);
  void tick();
  void publish();
  void keep_memory();
  void report(service::Health& health) const;

  service::Shell& shell_;
  ServiceConfig config_;
  std::string run_;
  std::optional<Memory> memory_;
  scenario::ScenarioClock clock_;
  World world_;
  std::map<std::string, geometry::Body> vehicles_;
  service::Outbox<topics::WorldObstacle> obstacles_;
};

}  // namespace aisle::fake_world
