#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/simulated/network.hpp"
#include "common/fleet/sign_off.hpp"
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

  /// From now on this vehicle is signed off whenever the leader counts it among the silent. `place_in_map`: where it is
  /// seen; none: nobody knows.
  void sign_off(const std::string& agv_id, const std::optional<geometry::Point2>& place_in_map) {
    signed_off_[agv_id] = {agv_id, place_in_map};
  }

 private:
  /// Gives its word for the vehicles that the leader waits for.
  void look();

  void take(const fleet::TrafficStatus& status, std::uint32_t epoch);

  std::unique_ptr<bus::simulated::SimulatedBus> bus_;
  service::OriginStamper stamper_;
  bus::Writer<topics::SignOff> writer_;
  std::map<std::string, fleet::SignOff> signed_off_;

  std::uint32_t epoch_{0};  // of the newest leader
  std::vector<fleet::SilentVehicle> silent_;
};

}  // namespace aisle::sim
