#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/fleet/goal.hpp"
#include "common/fleet/health.hpp"
#include "common/fleet/navigation.hpp"
#include "common/fleet/origin.hpp"
#include "common/fleet/vehicle.hpp"
#include "common/fleet/vehicle_state.hpp"
#include "common/time/stamp.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/traffic_view.hpp"

namespace aisle::cli {

/// What the fleet says of itself, at first hand: vehicles with what they do, and the services behind
/// them. Keeps the newest value of each.
class FleetView {
 public:
  /// Subscribes to vehicle_state, vehicle_info, navigation_status, goal, traffic_status and service_health.
  void watch(bus::Bus& bus);

  /// A value that came. `now`: on the bus's clock.
  void take(const fleet::VehicleState& state, time::Stamp now);
  void take(const fleet::Vehicle& vehicle);
  void take(const fleet::NavigationStatus& status);
  void take(const fleet::Goal& goal);
  void take(const fleet::ServiceHealth& health, const fleet::Origin& by);

  void take(const fleet::TrafficStatus& status, const fleet::Origin& by, time::Stamp now) {
    leader_.take(status, by, now);
  }

  /// Its local planner is gone, or silent.
  void lose_navigation(const std::string& agv_id);
  void lose_service(const std::string& instance_id);

  /// Was nothing heard at all?
  bool empty() const { return vehicles_.empty() && services_.empty(); }
  bool has_vehicles() const { return !vehicles_.empty(); }
  std::vector<std::string> vehicle_ids() const;

  /// {"vehicles": [...], "services": [...]}; a vehicle silent for more than a second is offline.
  Json snapshot(time::Stamp now) const;

 private:
  /// The newest values of one vehicle.
  struct VehicleEntry {
    std::optional<fleet::VehicleState> state;
    time::Stamp state_arrived{};
    std::optional<fleet::NavigationStatus> navigation;
    std::string goal_id;
  };

  Json snapshot(const std::string& agv_id, const VehicleEntry& vehicle, time::Stamp now) const;

  std::map<std::string, VehicleEntry> vehicles_;
  std::map<std::string, Json> services_;
  LeadersWord leader_;
};

/// The snapshot as two tables.
std::string text_of_fleet(const Json& snapshot);

}  // namespace aisle::cli
