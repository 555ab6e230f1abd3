#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include "common/fleet/command_authority.hpp"
#include "common/service/shell.hpp"
#include "services/fake-vehicle/core/body_book.hpp"
#include "services/fake-vehicle/core/duplicate_watch.hpp"
#include "services/fake-vehicle/core/simulated_vehicle.hpp"
#include "services/fake-vehicle/vehicle_memory.hpp"

namespace aisle::fake_vehicle {

struct ServiceConfig {
  Parameters vehicle;
  std::uint64_t seed{1};
  std::string run;  // names this vehicle's run in the state file
  geometry::Pose2 start_in_map;
  std::filesystem::path state_file;  // empty: nothing is kept

  template <class Reader>
  void describe(Reader& r) {
    vehicle.describe(r);
  }
};

/// One simulated vehicle on the bus. Listens for kListen first: when another process is this vehicle already, it says
/// so on `service_health`, writes nothing under the vehicle's name, and does not move, until the other is gone.
class FakeVehicleService {
 public:
  FakeVehicleService(service::Shell& shell, const ServiceConfig& config);
  FakeVehicleService(const FakeVehicleService&) = delete;
  FakeVehicleService& operator=(const FakeVehicleService&) = delete;

  static constexpr std::chrono::milliseconds kListen{600};

 private:
  void listen();
  bool is_this_vehicle(const fleet::ServiceHealth& health) const;
  void take(const fleet::VelocityCommand& command, const service::Sender& from);
  void tick();
  void publish();
  void publish_scan();
  fleet::VehicleState state();
  bool may_act(time::Stamp now);
  void keep_memory();
  void report(service::Health& health) const;

  service::Shell& shell_;
  std::string agv_id_;
  ServiceConfig config_;
  service::MapClient& map_;
  VehicleMemory memory_;  // of before a restart, or the start
  fleet::CommandAuthority authority_;
  std::optional<fleet::CommandInForce> command_;
  SimulatedVehicle vehicle_;
  BodyBook bodies_;
  DuplicateWatch duplicates_;
  std::mt19937_64 random_;
  service::Outbox<topics::VehicleInfo> infos_;
  service::Outbox<topics::VehicleState> states_;
  service::Outbox<topics::Scan> scans_;
  service::Outbox<topics::WorldObstacle> truths_;
  time::Stamp started_;
  time::Stamp next_scan_{};
  bool introduced_{false};
  bool yields_{false};
};

}  // namespace aisle::fake_vehicle
