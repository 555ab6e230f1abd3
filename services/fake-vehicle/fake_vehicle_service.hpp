#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

#include "common/bus/bus.hpp"
#include "common/fleet/command_authority.hpp"
#include "common/process/log.hpp"
#include "common/service/map_client.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/service/shell.hpp"
#include "common/wire/checks.hpp"
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
  FakeVehicleService(bus::Bus& bus, const std::string& agv_id, const std::string& instance_id, std::uint64_t boot_id,
                     service::Health& health, const ServiceConfig& config);
  FakeVehicleService(const FakeVehicleService&) = delete;
  FakeVehicleService& operator=(const FakeVehicleService&) = delete;

  static constexpr std::chrono::milliseconds kListen{600};

 private:
  void listen();
  bool is_this_vehicle(const fleet::ServiceHealth& health) const;
  void take(const aisle::VelocityCommand& sample, const bus::SampleInfo& info);
  void take(const aisle::WorldObstacle& sample, const bus::SampleInfo& info);
  void tick();
  void publish();
  void publish_scan();
  fleet::VehicleState state();
  template <class T>
  std::optional<T> accepted(const char* topic, wire::Decoded<T> decoded);
  bool may_act(time::Stamp now);
  void keep_memory();
  void tell_health(time::Stamp now);

  bus::Bus& bus_;
  std::string agv_id_;
  service::Health& health_;
  ServiceConfig config_;
  service::MapClient map_;
  VehicleMemory memory_;  // of before a restart, or the start
  fleet::CommandAuthority authority_;
  std::optional<fleet::CommandInForce> command_;
  SimulatedVehicle vehicle_;
  BodyBook bodies_;
  DuplicateWatch duplicates_;
  std::mt19937_64 random_;
  service::OriginStamper info_stamper_, state_stamper_, scan_stamper_, truth_stamper_;
  bus::Writer<topics::VehicleInfo> infos_;
  bus::Writer<topics::VehicleState> states_;
  bus::Writer<topics::Scan> scans_;
  bus::Writer<topics::WorldObstacle> truths_;
  process::LimitedWarnings warnings_;
  time::Stamp started_;
  time::Stamp next_scan_{};
  bool introduced_{false};
  bool yields_{false};
};

}  // namespace aisle::fake_vehicle
