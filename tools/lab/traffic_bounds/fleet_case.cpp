#include "tools/lab/traffic_bounds/fleet_case.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/scenario/data_path.hpp"
#include "common/scenario/variation.hpp"
#include "tools/lab/traffic/kinematic_site.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kApartM = 1.0;     // starts from each other, and first goals from each other
constexpr double kLeastLegM = 2.0;  // from a goal to the next
constexpr double kSecondsAGoal = 5.0;
constexpr std::size_t kLeastGoals = 40;

/// Points of the lattice on which a vehicle may stand and from which it reaches all others.
std::vector<Point2> lattice_points(const FloorModel& model) {
  const std::vector<bool> largest = in_largest_part(model.graph);
  const double need_m = model.floor.radius_m + model.kind.wall_margin_m;
  const grid::Geometry& geometry = model.grid.geometry();
  const double right = geometry.origin_in_map.x + geometry.width * geometry.resolution_m;
  const double top = geometry.origin_in_map.y + geometry.height * geometry.resolution_m;

  std::vector<Point2> points;
  for (double y = std::floor(geometry.origin_in_map.y) + 0.5; y < top; y += 1.0) {
    for (double x = std::floor(geometry.origin_in_map.x) + 0.5; x < right; x += 1.0) {
      const Point2 low = model.floor.low_in_map, high = model.floor.high_in_map;
      if (x < low.x || y < low.y || x > high.x || y > high.y) continue;
      if (model.clearance.clearance_m(Point2{x, y}) < need_m) continue;

      const global_planner::traffic::PlaceId place = model.roadmap.nearest(model.kind_id, {x, y, 0.0});
      if (place == global_planner::traffic::kNoId) continue;

      const Point2 at = model.roadmap.place(place).base_in_map.position();
      if (largest[nearest_vertex(model.graph, at)]) points.push_back({x, y});
    }
  }

  return points;
}

bool is_apart(Point2 point, const std::vector<Point2>& others) {
  return std::all_of(others.begin(), others.end(),
                     [&](Point2 other) { return geometry::distance(point, other) > kApartM - 1e-6; });
}

/// The first drawn point that is apart from those drawn before; where chance finds none, the first free one at all.
Point2 draw_apart(const std::vector<Point2>& points, const std::vector<Point2>& before, std::mt19937_64& random,
                  const std::string& floor) {
  for (int tries = 0; tries < 1000; ++tries) {
    const Point2 point = points[random() % points.size()];
    if (is_apart(point, before)) return point;
  }

  for (const Point2 point : points)
    if (is_apart(point, before)) return point;
  throw config::BadInput("the floor '" + floor + "' has room for " + std::to_string(before.size()) +
                         " vehicles only: ask for fewer");
}

}  // namespace

const char* const kFleetRule =
    "points (i + 0.5, j + 0.5) m of the map on which a vehicle has 0.1 m beside it and that a place of the roadmap's "
    "largest part reaches straight; agv-i draws with the seed and its id: a start and a first goal at least 1 m from "
    "those of the vehicles before it, then goals at least 2 m from the one before";

std::vector<Floor> known_floors(const std::filesystem::path& warehouse_map) {
  std::vector<Floor> floors;
  Floor warehouse;
  warehouse.name = "warehouse";
  warehouse.map_file = warehouse_map;
  floors.push_back(warehouse);

  try {
    Floor block;
    block.name = "movingai";
    block.map_file = scenario::find_named_file("data:movingai/warehouse-10-20-10-2-1.map", warehouse_map);
    block.map_options = {2.0, 8};
    block.radius_m = 0.30;
    block.low_in_map = {60.0, 20.0};
    block.high_in_map = {180.0, 100.0};
    floors.push_back(block);
  } catch (const config::BadInput&) {
    // The reference data is not there.
  }

  return floors;
}

FloorModel::FloorModel(const Floor& floor_in)
    : floor(floor_in), grid(grid::read_map_file(floor.map_file, floor.map_options)), clearance(grid) {
  scenario::Vehicle vehicle;
  vehicle.radius_m = floor.radius_m;
  kind = kind_of(vehicle);

  roadmap.set_map(clearance, {0, 0}, {clearance.geometry().width - 1, clearance.geometry().height - 1});
  kind_id = roadmap.kind(kind);
  graph = step_graph(roadmap, kind_id);
}

scenario::Scenario draw_fleet(const FloorModel& model, std::uint64_t seed, std::size_t vehicles, double duration_s) {
  scenario::Scenario fleet;
  fleet.name = model.floor.name;
  fleet.map_file = model.floor.map_file;
  fleet.map_options = model.floor.map_options;
  fleet.seed = seed;
  fleet.duration_s = duration_s;

  const std::vector<Point2> points = lattice_points(model);
  if (points.size() < 2) throw config::BadInput("the floor '" + model.floor.name + "' has no room for a vehicle");

  const std::size_t goals = std::max(kLeastGoals, static_cast<std::size_t>(duration_s / kSecondsAGoal));
  std::vector<Point2> starts, first_goals;

  for (std::size_t i = 0; i < vehicles; ++i) {
    scenario::Vehicle vehicle;
    vehicle.id = "agv-" + std::to_string(i + 1);
    vehicle.radius_m = model.floor.radius_m;
    std::mt19937_64 random = scenario::random_for(seed, "fleet " + vehicle.id);

    starts.push_back(draw_apart(points, starts, random, model.floor.name));
    first_goals.push_back(draw_apart(points, first_goals, random, model.floor.name));
    const double yaw = geometry::kPi * (static_cast<double>(random() % 2000) / 1000.0 - 1.0);
    vehicle.start_in_map = {starts.back().x, starts.back().y, yaw};

    scenario::Mission mission;
    mission.vehicle = vehicle.id;
    Point2 last = first_goals.back();
    mission.goals_in_map.push_back({last.x, last.y, 0.0});
    while (mission.goals_in_map.size() < goals) {
      const Point2 next = points[random() % points.size()];
      if (geometry::distance(last, next) < kLeastLegM && points.size() > 20) continue;
      mission.goals_in_map.push_back({next.x, next.y, 0.0});
      last = next;
    }

    fleet.vehicles.push_back(std::move(vehicle));
    fleet.missions.push_back(std::move(mission));
  }

  return fleet;
}

scenario::Scenario first_of(const scenario::Scenario& fleet, std::size_t vehicles, std::optional<std::size_t> goals) {
  scenario::Scenario part = fleet;
  part.vehicles.resize(std::min(vehicles, part.vehicles.size()));
  part.missions.resize(part.vehicles.size());
  for (scenario::Mission& mission : part.missions)
    if (goals && mission.goals_in_map.size() > *goals) mission.goals_in_map.resize(*goals);
  return part;
}

scenario::Scenario alone(const scenario::Scenario& fleet, std::size_t vehicle) {
  scenario::Scenario one = fleet;
  one.vehicles = {fleet.vehicles[vehicle]};
  one.missions = {fleet.missions[vehicle]};
  return one;
}

}  // namespace aisle::lab
