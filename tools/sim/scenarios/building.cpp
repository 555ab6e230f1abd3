#include "tools/sim/scenarios/building.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace aisle::sim {

using geometry::Point2;
using geometry::Pose2;

namespace {

/// Cells whose centres lie within the rectangle.
void fill(grid::OccupancyGrid& grid, double x0, double y0, double x1, double y1, grid::Occupancy with) {
  const auto& g = grid.geometry();
  for (int y = 0; y < g.height; ++y)
    for (int x = 0; x < g.width; ++x) {
      const Point2 c = g.center_in_map({x, y});
      if (c.x > x0 && c.x < x1 && c.y > y0 && c.y < y1) grid.set({x, y}, with);
    }
}

}  // namespace

grid::OccupancyGrid hall(double width_m, double height_m, double resolution_m) {
  grid::OccupancyGrid grid(grid::Geometry{static_cast<int>(std::lround(width_m / resolution_m)),
                                          static_cast<int>(std::lround(height_m / resolution_m)),
                                          resolution_m,
                                          {0.0, 0.0}});

  const auto& g = grid.geometry();
  for (int y = 0; y < g.height; ++y)
    for (int x = 0; x < g.width; ++x)
      if (x == 0 || y == 0 || x == g.width - 1 || y == g.height - 1) grid.set({x, y}, grid::Occupancy::kOccupied);

  return grid;
}

void block(grid::OccupancyGrid& grid, double x0, double y0, double x1, double y1) {
  fill(grid, x0, y0, x1, y1, grid::Occupancy::kOccupied);
}

void carve(grid::OccupancyGrid& grid, double x0, double y0, double x1, double y1) {
  fill(grid, x0, y0, x1, y1, grid::Occupancy::kFree);
}

void add_vehicle(Setup& setup, int number, Pose2 start, std::vector<Pose2> goals, double radius_m) {
  scenario::Vehicle vehicle;
  vehicle.id = "agv-" + std::to_string(number);
  vehicle.start_in_map = start;
  vehicle.radius_m = radius_m;
  setup.scenario.vehicles.push_back(vehicle);

  scenario::Mission mission;
  mission.vehicle = vehicle.id;
  mission.goals_in_map = std::move(goals);
  setup.scenario.missions.push_back(mission);
}

void add_mover(Setup& setup, double speed_mps, double start_s, bool courteous, std::vector<Point2> waypoints) {
  scenario::Mover mover;
  mover.id = "person-" + std::to_string(setup.scenario.movers.size() + 1);
  mover.speed_mps = speed_mps;
  mover.start_s = start_s;
  mover.loop = courteous;
  mover.courteous = courteous;
  mover.waypoints_in_map = std::move(waypoints);
  setup.scenario.movers.push_back(mover);
}

/// Draws until a pose fits. @pre there is such a place
Pose2 free_pose(const grid::ClearanceField& clearance, Dice& dice, double room_m, const std::vector<Pose2>& away_from,
                double away_m) {
  const auto& g = clearance.geometry();
  for (;;) {
    const Pose2 pose{dice.between(0.5, g.width * g.resolution_m - 0.5),
                     dice.between(0.5, g.height * g.resolution_m - 0.5), dice.between(-3.1, 3.1)};
    if (clearance.clearance_m(pose.position()) < room_m) continue;

    if (std::all_of(away_from.begin(), away_from.end(),
                    [&](const Pose2& p) { return geometry::distance(p.position(), pose.position()) > away_m; }))
      return pose;
  }
}

/// All starts are drawn before all goals; neither lie near each other.
void add_fleet(Setup& setup, Dice& dice, int count, int goals, double radius_m, double room_m, double away_m) {
  const grid::ClearanceField clearance(setup.grid, 3.0);
  std::vector<Pose2> starts, taken;

  for (int i = 0; i < count; ++i) {
    starts.push_back(free_pose(clearance, dice, room_m, taken, away_m));
    taken.push_back(starts.back());
  }

  std::vector<Pose2> used;
  for (int i = 0; i < count; ++i) {
    std::vector<Pose2> list;
    for (int k = 0; k < goals; ++k) {
      list.push_back(free_pose(clearance, dice, room_m, used, away_m));
      used.push_back(list.back());
    }

    add_vehicle(setup, i + 1, starts[static_cast<std::size_t>(i)], list, radius_m);
  }
}

}  // namespace aisle::sim
