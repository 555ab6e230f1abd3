#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/fleet/grant.hpp"
#include "common/fleet/navigation.hpp"
#include "common/fleet/origin.hpp"
#include "common/fleet/plan.hpp"
#include "common/fleet/traffic_status.hpp"
#include "common/fleet/vehicle.hpp"
#include "common/fleet/vehicle_state.hpp"
#include "common/time/stamp.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/traffic_picture.hpp"

namespace aisle::cli {

/// The newest traffic status of the planner that leads: of two planners the one with the higher epoch.
class LeadersWord {
 public:
  /// A status that came. `now`: on the bus's clock.
  void take(const fleet::TrafficStatus& status, const fleet::Origin& by, time::Stamp now);

  /// This planner is gone.
  void lose(const std::string& source_id);

  bool is_there() const { return status_.has_value(); }

  /// @pre is_there(); the same for by() and arrived()
  const fleet::TrafficStatus& status() const { return *status_; }
  const fleet::Origin& by() const { return by_; }
  time::Stamp arrived() const { return arrived_; }

  /// What the leader says of this waiting vehicle; null when it names none.
  const fleet::WaitingVehicle* find_waiting(const std::string& agv_id) const;

 private:
  std::optional<fleet::TrafficStatus> status_;
  fleet::Origin by_;
  time::Stamp arrived_{};
};

/// The traffic as the leading planner and the vehicles tell it: which vehicle waits for which, since when and why; what
/// is planned and granted. Keeps the newest value of each.
class TrafficView {
 public:
  /// Subscribes to traffic_status, grant, plan, navigation_status, vehicle_state and vehicle_info.
  void watch(bus::Bus& bus);

  /// A value that came. `now`: on the bus's clock.
  void take(const fleet::TrafficStatus& status, const fleet::Origin& by, time::Stamp now) {
    leader_.take(status, by, now);
  }
  void take(const fleet::Grant& grant) { vehicles_[grant.agv_id].grant = grant; }
  void take(const fleet::Plan& plan) { vehicles_[plan.agv_id].plan = plan; }
  void take(const fleet::NavigationStatus& status) { vehicles_[status.agv_id].navigation = status; }
  void take(const fleet::VehicleState& state) { vehicles_[state.agv_id].state = state; }
  void take(const fleet::Vehicle& vehicle) { vehicles_[vehicle.id].kind = vehicle; }

  void lose_planner(const std::string& source_id) { leader_.lose(source_id); }
  void lose_navigation(const std::string& agv_id) { vehicles_[agv_id].navigation.reset(); }

  bool has_leader() const { return leader_.is_there(); }

  /// {"leader": {...}, "vehicles": n, ..., "waiting": [...], "silent": [...]}. @pre has_leader()
  Json snapshot(time::Stamp now) const;

  /// For the picture: each vehicle with a known pose, by id.
  std::vector<DrawnVehicle> drawn() const;

 private:
  /// The newest values of one vehicle.
  struct VehicleEntry {
    std::optional<fleet::Vehicle> kind;
    std::optional<fleet::VehicleState> state;
    std::optional<fleet::NavigationStatus> navigation;
    std::optional<fleet::Plan> plan;
    std::optional<fleet::Grant> grant;
  };

  /// Null for a vehicle that does not wait.
  Json waiting(const std::string& agv_id, const VehicleEntry& vehicle) const;

  LeadersWord leader_;
  std::map<std::string, VehicleEntry> vehicles_;
};

/// The snapshot as lines and tables.
std::string text_of_traffic(const Json& snapshot);

}  // namespace aisle::cli
