#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/bus/simulated/network.hpp"
#include "common/fleet/traffic_status.hpp"
#include "common/service/origin_stamper.hpp"

namespace aisle::sim {

/// The person at a simulated site that signs dead vehicles off. Reads the leader's traffic status and gives its word on
/// the bus, on a host of its own, as `aisle fleet sign-off` does.
class Supervisor {
 public:
  /// Joins the network, which must outlive it.
  explicit Supervisor(bus::simulated::Network& network);
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// From now on this vehicle is signed off whenever the leader counts it among the silent.
  void sign_off(const std::string& agv_id) { signed_off_.insert(agv_id); }

 private:
  /// Gives its word for the vehicles that the leader waits for.
  void look();

  void take(const fleet::TrafficStatus& status, std::uint32_t epoch);

  std::unique_ptr<bus::simulated::SimulatedBus> bus_;
  service::OriginStamper stamper_;
  bus::Writer<topics::SignOff> writer_;
  std::set<std::string> signed_off_;

  std::uint32_t epoch_{0};  // of the newest leader
  std::vector<fleet::SilentVehicle> silent_;
};

}  // namespace aisle::sim
