#pragma once
#include <map>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/time/stamp.hpp"
#include "tools/cli/json/json.hpp"

namespace aisle::cli {

/// What the fleet says of itself, newest first hand: vehicles with what they do, and the services behind them.
class FleetView {
 public:
  /// Subscribes to vehicle_state, vehicle_info, navigation_status, goal and service_health.
  void watch(bus::Bus& bus);

  void take(const aisle::VehicleState& sample, time::Stamp now);
  void take(const aisle::VehicleInfo& sample);
  void take(const aisle::NavigationStatus& sample);
  void take(const aisle::Goal& sample);
  void take(const aisle::ServiceHealth& sample);
  void lose_navigation(const std::string& agv_id);
  void lose_service(const std::string& instance_id);

  bool empty() const { return vehicles_.empty() && services_.empty(); }
  bool has_vehicles() const { return !vehicles_.empty(); }
  std::vector<std::string> vehicle_ids() const;

  /// {"vehicles": [...], "services": [...]}; a vehicle silent for more than a second is offline.
  Json snapshot(time::Stamp now) const;

 private:
  struct Vehicle {
    bool has_state{false};
    aisle::VehicleState state;
    time::Stamp state_arrived{};
    bool has_navigation{false};
    aisle::NavigationStatus navigation;
    std::string goal_id;
  };
  Json snapshot(const std::string& agv_id, const Vehicle& vehicle, time::Stamp now) const;

  std::map<std::string, Vehicle> vehicles_;
  std::map<std::string, Json> services_;
};

/// The snapshot as two tables.
std::string text_of_fleet(const Json& snapshot);

}  // namespace aisle::cli
