#include "tools/cli/fleet_view.hpp"

#include <fmt/format.h>

#include "common/bus/topics.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr time::Stamp kOfflineAfter = std::chrono::seconds(1);

std::string number(const Json& row, const char* key, const char* form) {
  return row.contains(key) && row[key].is_number() ? fmt::format(fmt::runtime(form), row[key].get<double>()) : "-";
}

std::string word(const Json& row, const char* key) {
  const std::string text = row.value(key, "");
  return text.empty() || text == "none" ? "-" : text;
}

}  // namespace

void FleetView::watch(bus::Bus& bus) {
  const auto is_data = [](const bus::SampleInfo& info) { return info.kind == bus::SampleKind::kData; };
  bus.on<topics::VehicleState>([this, is_data](const aisle::VehicleState& sample, const bus::SampleInfo& info) {
    if (is_data(info)) take(sample, info.arrived);
  });
  bus.on<topics::VehicleInfo>([this, is_data](const aisle::VehicleInfo& sample, const bus::SampleInfo& info) {
    if (is_data(info)) take(sample);
  });
  bus.on<topics::NavigationStatus>([this, is_data](const aisle::NavigationStatus& sample, const bus::SampleInfo& info) {
    if (is_data(info)) {
      take(sample);
    } else {
      lose_navigation(sample.agv_id().to_string());
    }
  });
  bus.on<topics::Goal>([this, is_data](const aisle::Goal& sample, const bus::SampleInfo& info) {
    if (is_data(info)) take(sample);
  });
  bus.on<topics::ServiceHealth>([this, is_data](const aisle::ServiceHealth& sample, const bus::SampleInfo& info) {
    if (is_data(info)) {
      take(sample);
    } else {
      lose_service(sample.instance_id().to_string());
    }
  });
}

void FleetView::take(const aisle::VehicleState& sample, time::Stamp now) {
  Vehicle& vehicle = vehicles_[sample.agv_id().to_string()];
  vehicle.has_state = true;
  vehicle.state = sample;
  vehicle.state_arrived = now;
}

void FleetView::take(const aisle::VehicleInfo& sample) { vehicles_.try_emplace(sample.agv_id().to_string()); }

void FleetView::take(const aisle::NavigationStatus& sample) {
  Vehicle& vehicle = vehicles_[sample.agv_id().to_string()];
  vehicle.has_navigation = true;
  vehicle.navigation = sample;
}

void FleetView::take(const aisle::Goal& sample) {
  vehicles_[sample.agv_id().to_string()].goal_id = sample.cancelled() ? "" : sample.goal_id().to_string();
}

void FleetView::take(const aisle::ServiceHealth& sample) {
  services_[sample.instance_id().to_string()] = to_json(sample);
}

void FleetView::lose_navigation(const std::string& agv_id) {
  const auto vehicle = vehicles_.find(agv_id);
  if (vehicle != vehicles_.end()) vehicle->second.has_navigation = false;
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

Json FleetView::snapshot(const std::string& agv_id, const Vehicle& vehicle, time::Stamp now) const {
  Json row{{"agv_id", agv_id}, {"online", vehicle.has_state && now - vehicle.state_arrived <= kOfflineAfter}};
  if (vehicle.has_navigation) {
    const aisle::NavigationStatus& navigation = vehicle.navigation;
    row["phase"] = name_of(navigation.phase());
    row["reason"] = name_of(navigation.reason());
    row["detail"] = navigation.detail().to_string();
    row["distance_left_m"] = navigation.distance_left_m();
    row["time_left_s"] = navigation.time_left_s();
  }
  const std::string navigated = vehicle.has_navigation ? vehicle.navigation.goal_id().to_string() : "";
  row["goal_id"] = navigated.empty() ? vehicle.goal_id : navigated;
  if (vehicle.has_state) {
    row["hold"] = name_of(vehicle.state.hold());
    row["speed_mps"] = vehicle.state.twist().linear_mps();
    row["base_in_map"] = to_json(vehicle.state.base_in_map());
    row["refused_commands"] = vehicle.state.refused_commands();
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

std::string text_of_fleet(const Json& snapshot) {
  std::vector<std::vector<std::string>> vehicles{
      {"VEHICLE", "PHASE", "REASON", "GOAL", "LEFT m", "SPEED m/s", "X m", "Y m", "HOLD"}};
  for (const Json& row : snapshot["vehicles"]) {
    const Json pose = row.value("base_in_map", Json::object());
    vehicles.push_back({row["agv_id"], row.contains("phase") ? word(row, "phase") : "no local planner",
                        word(row, "reason"), word(row, "goal_id"), number(row, "distance_left_m", "{:.1f}"),
                        number(row, "speed_mps", "{:.2f}"), number(pose, "x_m", "{:.2f}"),
                        number(pose, "y_m", "{:.2f}"), row["online"] ? word(row, "hold") : "offline"});
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
