#include "tools/lab/driving/printed_drive.hpp"

#include "services/global-planner/core/variant.hpp"

namespace aisle::lab {
namespace {

constexpr double kLongestS = 300.0;  // then the vehicle has not arrived

const char* model_name(kinematics::Model model) {
  switch (model) {
    case kinematics::Model::kOmnidirectional:
      return "omnidirectional";
    case kinematics::Model::kTricycle:
      return "tricycle";
    case kinematics::Model::kDifferential:
      break;
  }
  return "differential";
}

}  // namespace

std::string global_planner_of(const local_planner::Variant& variant) {
  return global_planner::find_variant(variant.name) != nullptr ? variant.name : "direct";
}

sim::Setup printed_setup(const DrawnMap& map, const local_planner::Variant& variant, const std::string& global,
                         std::optional<double> start_yaw_rad) {
  sim::Setup setup;
  setup.grid = map.grid;
  setup.planner = global;
  setup.local = variant.name;
  setup.own_variant = variant;
  setup.paper_limits = true;
  setup.as_printed = true;
  setup.perception = sim::Perception::kTruth;

  scenario::Vehicle vehicle;
  vehicle.id = "agv-1";
  vehicle.model = model_name(variant.printed.model);
  vehicle.radius_m = variant.printed.radius_m;
  const double to_goal_rad = geometry::bearing(map.start_in_map, map.goal_in_map);
  const double printed_yaw_rad = variant.printed.start_yaw_rad.value_or(to_goal_rad);
  vehicle.start_in_map = {map.start_in_map.x, map.start_in_map.y, start_yaw_rad.value_or(printed_yaw_rad)};
  setup.scenario.vehicles.push_back(vehicle);

  scenario::Mission mission;
  mission.vehicle = vehicle.id;
  mission.goals_in_map = {{map.goal_in_map.x, map.goal_in_map.y, 0.0}};
  setup.scenario.missions.push_back(mission);
  setup.scenario.name = "as-printed-" + variant.name;
  setup.scenario.duration_s = kLongestS;
  return setup;
}

}  // namespace aisle::lab
