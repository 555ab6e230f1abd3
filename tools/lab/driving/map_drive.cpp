#include "tools/lab/driving/map_drive.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/config/reader.hpp"
#include "services/global-planner/core/planner.hpp"
#include "tools/sim/scenarios/gap_to_walls.hpp"

namespace aisle::lab {
namespace {

constexpr double kShortestRunS = 300.0;  // at the longest; a larger map gets more
constexpr double kLookM = 0.1;           // from the outline, for walls

void check_end(const std::string& name, const char* what, geometry::Point2 in_map, const grid::OccupancyGrid& grid,
               double radius_m) {
  const std::string where = fmt::format("{}: the {} ({:.2f}, {:.2f})", name, what, in_map.x, in_map.y);
  if (!global_planner::is_in_map(grid.geometry(), in_map)) throw config::BadInput(where + " is outside the map");

  const geometry::Body body{geometry::Body::Shape::kDisc, {in_map.x, in_map.y, 0.0}, radius_m};
  if (sim::gap_to_walls_m(grid, body, kLookM) <= 0.0)
    throw config::BadInput(
        fmt::format("{} has no room for a vehicle of radius {:g} m: move it, or make the vehicle's radius smaller",
                    where, radius_m));
}

}  // namespace

void check_ends(const std::string& name, const grid::OccupancyGrid& grid, const Query& query, double radius_m) {
  check_end(name, "start", query.start_in_map, grid, radius_m);
  check_end(name, "goal", query.goal_in_map, grid, radius_m);
}

sim::Setup map_setup(const std::string& name, const Subject& subject, const Query& query, double radius_m) {
  check_ends(name, subject.grid, query, radius_m);

  sim::Setup setup;
  setup.grid = subject.grid;
  setup.scenario.name = name;

  scenario::Vehicle vehicle;
  vehicle.id = "agv-1";
  vehicle.radius_m = radius_m;
  const double to_goal_rad = geometry::bearing(query.start_in_map, query.goal_in_map);
  vehicle.start_in_map = {query.start_in_map.x, query.start_in_map.y, subject.start_yaw_rad.value_or(to_goal_rad)};
  setup.scenario.vehicles.push_back(vehicle);

  scenario::Mission mission;
  mission.vehicle = vehicle.id;
  mission.goals_in_map = {{query.goal_in_map.x, query.goal_in_map.y, subject.goal_yaw_rad.value_or(0.0)}};
  mission.heading_matters = subject.goal_yaw_rad.has_value();
  setup.scenario.missions.push_back(mission);

  const grid::Geometry& geometry = subject.grid.geometry();
  const double around_m = 2.0 * (geometry.width + geometry.height) * geometry.resolution_m;
  setup.scenario.duration_s = std::max(kShortestRunS, 2.0 * around_m / vehicle.max_speed_mps);

  return setup;
}

}  // namespace aisle::lab
