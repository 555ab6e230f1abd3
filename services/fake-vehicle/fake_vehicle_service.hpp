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

/// What the process takes from its config file and its command line, for one vehicle.
struct ServiceConfig {
  Parameters vehicle;
  std::uint64_t seed{1};
  std::string run;  // names this vehicle's run in the state file
  geometry::Pose2 start_in_map;
  std::filesystem::path state_file;     // empty: nothing is kept
  const Hindrance* hindrance{nullptr};  // read in each cycle, and must outlive the service; null: none

  template <class Reader>
  void describe(Reader& r) {
    vehicle.describe(r);
  }
};

/// One simulated vehicle on the bus: obeys `velocity_command`, writes `vehicle_info`, `vehicle_state` and `scan` as a
/// real one does, and its true body to `world_obstacle` for the other simulators.
///
/// Listens for kListen first: when another process is this vehicle already, it says so on `service_health`, writes
/// nothing under the vehicle's name, and does not move, until the other is gone.
class FakeVehicleService {
 public:
  /// Recalls the state file, registers topics and timers with `shell`, which must outlive this object.
  FakeVehicleService(service::Shell& shell, const ServiceConfig& config);
  FakeVehicleService(const FakeVehicleService&) = delete;
  FakeVehicleService& operator=(const FakeVehicleService&) = delete;

  static constexpr std::chrono::milliseconds kListen{600};  // after its start, before it writes anything

 private:
  /// Registers what is read with the shell.
  void listen();

  /// Is it the health of a process that simulates a vehicle of this id, this process included?
  bool is_this_vehicle(const fleet::ServiceHealth& health) const;

  /// Hands a command to the vehicle if its source has the authority; counts and logs the refused ones.
  void take(const fleet::VelocityCommand& command, const service::Sender& from);

  /// Moves the vehicle on by one period and publishes.
  void tick();

  /// Writes the state, and the true body.
  void publish();

  /// One turn of the scanner, with the pose that the vehicle believes.
  void publish_scan();

  /// The state to publish now; draws an error of the pose.
  fleet::VehicleState state();

  /// False while it listens and while another process is this vehicle. Logs when the latter changes.
  bool may_act(time::Stamp now);

  /// Writes the state file, ten times a second.
  void keep_memory();

  /// Counters, what is waited for, and whether the vehicle's id is used twice.
  void report(service::Health& health) const;

  service::Shell& shell_;
  std::string agv_id_;
  ServiceConfig config_;

  service::MapClient& map_;
  VehicleMemory memory_;  // of before a restart, or the start
  fleet::CommandAuthority authority_;
  std::optional<fleet::CommandInForce> command_;  // the newest accepted one
  SimulatedVehicle vehicle_;
  BodyBook bodies_;
  DuplicateWatch duplicates_;
  std::mt19937_64 random_;  // of pose and range noise

  service::Outbox<topics::VehicleInfo> infos_;
  service::Outbox<topics::VehicleState> states_;
  service::Outbox<topics::Scan> scans_;
  service::Outbox<topics::WorldObstacle> truths_;

  time::Stamp started_;
  time::Stamp next_scan_{};
  bool introduced_{false};  // vehicle_info was written
  bool yields_{false};      // to another process of the same name
};

}  // namespace aisle::fake_vehicle
