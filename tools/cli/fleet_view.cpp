#include "tools/cli/fleet_view.hpp"

#include <fmt/format.h>

#include "common/bus/topics.hpp"
#include "common/fleet/any_vehicle.hpp"
#include "common/service/hear.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr time::Stamp kOfflineAfter = std::chrono::seconds(1);

/// The number under `key` in this form; "-" where there is none.
std::string number(const Json& row, const char* key, const char* form) {
  return row.contains(key) && row[key].is_number() ? fmt::format(fmt::runtime(form), row[key].get<double>()) : "-";
}

/// "agv-2 7 s: the lane is taken", the last column, so that long reasons keep the others narrow.
std::string wait_of(const Json& row) {
  if (!row.contains("waits_since_s")) return "-";

  const std::string other = row.value("waits_for", "");
  const std::string why = row.value("waits_because", "");
  return fmt::format("{} {:.0f} s{}", other.empty() ? "-" : other, row["waits_since_s"].get<double>(),
                     why.empty() ? "" : ": " + why);
}

}  // namespace

/// One reader for each kind of row.
void FleetView::watch(bus::Bus& bus) {
  using service::End;
  using service::hear;
  using service::Sender;

  hear<topics::VehicleState>(
      bus, {[this](const fleet::VehicleState& state, const Sender& from) { take(state, from.arrived); }, {}, {}});
  hear<topics::VehicleInfo>(bus, {[this](const fleet::Vehicle& vehicle, const Sender&) { take(vehicle); }, {}, {}});

  hear<topics::NavigationStatus>(bus, {[this](const fleet::NavigationStatus& status, const Sender&) { take(status); },
                                       [this](const std::string& agv_id, End) { lose_navigation(agv_id); },
                                       {}});

  hear<topics::Goal>(bus, {[this](const fleet::Goal& goal, const Sender&) { take(goal); }, {}, {}});

  hear<topics::TrafficStatus>(
      bus, {[this](const fleet::TrafficStatus& status, const Sender& from) { take(status, from.by, from.arrived); },
            [this](const std::string& source_id, End) { leader_.lose(source_id); },
            {}});

  hear<topics::ServiceHealth>(
      bus, {[this](const fleet::ServiceHealth& health, const Sender& from) { take(health, from.by); },
            [this](const std::string& instance_id, End) { lose_service(instance_id); },
            {}});
}

void FleetView::take(const fleet::VehicleState& state, time::Stamp now) {
  VehicleEntry& vehicle = vehicles_[state.agv_id];
  vehicle.state = state;
  vehicle.state_arrived = now;
}

void FleetView::take(const fleet::Vehicle& vehicle) { vehicles_.try_emplace(vehicle.id); }

void FleetView::take(const fleet::NavigationStatus& status) { vehicles_[status.agv_id].navigation = status; }

void FleetView::take(const fleet::Goal& goal) {
  if (goal.agv_id == fleet::kAnyVehicle) return;
  vehicles_[goal.agv_id].goal_id = goal.is_cancelled ? "" : goal.id;
}

void FleetView::take(const fleet::ServiceHealth& health, const fleet::Origin& by) {
  services_[health.instance_id] = json_of(health, by);
}

void FleetView::lose_navigation(const std::string& agv_id) {
  const auto vehicle = vehicles_.find(agv_id);
  if (vehicle != vehicles_.end()) vehicle->second.navigation.reset();
}

void FleetView::lose_service(const std::string& instance_id) {
  const auto service = services_.find(instance_id);
  if (service != services_.end()) service->second["state"] = "gone";
}

std::vector<std::string> FleetView::vehicle_ids() const {
  std::vector<std::string> ids;
  for (const auto& [id, vehicle] : vehicles_) ids.push_back(id);
  return ids;
}

/// Without a local planner's word, only state and goal are shown.
Json FleetView::snapshot(const std::string& agv_id, const VehicleEntry& vehicle, time::Stamp now) const {
  Json row{{"agv_id", agv_id}, {"online", vehicle.state && now - vehicle.state_arrived <= kOfflineAfter}};
  if (vehicle.navigation) {
    const fleet::NavigationStatus& navigation = *vehicle.navigation;
    row["phase"] = word_of(name(navigation.phase));
    row["reason"] = word_of(name(navigation.reason));
    row["detail"] = navigation.detail;
    row["distance_left_m"] = navigation.distance_left_m;
    row["time_left_s"] = navigation.time_left_s;
  }

  const std::string navigated = vehicle.navigation ? vehicle.navigation->goal_id : "";
  row["goal_id"] = navigated.empty() ? vehicle.goal_id : navigated;

  if (const fleet::WaitingVehicle* const waiting = leader_.find_waiting(agv_id)) {
    row["waits_for"] = waiting->waits_for;
    row["waits_since_s"] = waiting->since_s;
    row["waits_because"] = waiting->reason;
  }

  if (vehicle.state) {
    row["hold"] = word_of(name(vehicle.state->hold));
    row["speed_mps"] = vehicle.state->motion.twist.linear_mps;
    row["base_in_map"] = to_json(vehicle.state->motion.base_in_map);
    row["refused_commands"] = vehicle.state->refused_commands;
    row["silent_s"] = time::seconds(now - vehicle.state_arrived);
  }

  return row;
}

Json FleetView::snapshot(time::Stamp now) const {
  Json vehicles = Json::array();
  for (const auto& [id, vehicle] : vehicles_) vehicles.push_back(snapshot(id, vehicle, now));

  Json services = Json::array();
  for (const auto& [id, health] : services_) services.push_back(health);

  return Json{{"vehicles", std::move(vehicles)}, {"services", std::move(services)}};
}

/// From the JSON, so that both outputs say the same.
std::string text_of_fleet(const Json& snapshot) {
  std::vector<std::vector<std::string>> vehicles{
      {"VEHICLE", "PHASE", "REASON", "GOAL", "LEFT m", "SPEED m/s", "X m", "Y m", "HOLD", "WAITS FOR"}};
  for (const Json& row : snapshot["vehicles"]) {
    const Json pose = row.value("base_in_map", Json::object());
    vehicles.push_back({row["agv_id"], row.contains("phase") ? word(row, "phase") : "no local planner",
                        word(row, "reason"), word(row, "goal_id"), number(row, "distance_left_m", "{:.1f}"),
                        number(row, "speed_mps", "{:.2f}"), number(pose, "x_m", "{:.2f}"),
                        number(pose, "y_m", "{:.2f}"), row["online"] ? word(row, "hold") : "offline", wait_of(row)});
  }

  std::vector<std::vector<std::string>> services{
      {"SERVICE", "STATE", "WAITS FOR", "HOST", "CPU %", "MB", "LAST ERROR"}};
  for (const Json& row : snapshot["services"]) {
    services.push_back({row["instance_id"], row["state"], word(row, "waits_for"), word(row, "host"),
                        number(row, "cpu_percent", "{:.1f}"), number(row, "resident_mb", "{:.1f}"),
                        word(row, "last_error")});
  }

  return text_of_table(vehicles) + "\n" + text_of_table(services);
}

}  // namespace aisle::cli
