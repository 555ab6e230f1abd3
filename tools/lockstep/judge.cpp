#include "tools/lockstep/judge.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::lockstep {
namespace {

using geometry::Point2;

constexpr double kTouchM = 0.001;        // a simulated vehicle is stopped just before it overlaps
constexpr double kApartM = 0.02;
constexpr double kLookM = 1.0;

/// To the nearest square cell that is not free.
double distance_to_walls_m(const grid::OccupancyGrid& walls, Point2 p) {
  const grid::Geometry& g = walls.geometry();
  const grid::Cell c = g.cell_at(p);
  const int reach = static_cast<int>(std::ceil(kLookM / g.resolution_m));
  double least = kLookM;
  for (int y = c.y - reach; y <= c.y + reach; ++y)
    for (int x = c.x - reach; x <= c.x + reach; ++x) {
      if (walls.is_free({x, y})) continue;
      const Point2 d = p - g.center_in_map({x, y});
      const double half = 0.5 * g.resolution_m;
      least = std::min(least, std::hypot(std::max(0.0, std::abs(d.x) - half), std::max(0.0, std::abs(d.y) - half)));
    }
  return least;
}

}  // namespace

void Judge::pair(const Vehicle& vehicle, const std::string& other, double gap_m, Result& result, std::vector<std::string>& lines) {
  if (vehicle.is_moving) result.least_clearance_m = std::min(result.least_clearance_m, gap_m);
  const std::string key = vehicle.id + " " + other;
  if (gap_m > kApartM) {
    touching_.erase(key);
    moving_.erase(key);
  }
  if (gap_m > kTouchM) return;
  const bool begins = touching_.insert(key).second;
  const bool begins_moving = vehicle.is_moving && moving_.insert(key).second;
  if (begins) ++result.contacts;
  if (begins_moving) ++result.contacts_moving_vehicle;
  if (begins || begins_moving) lines.push_back("CONTACT " + key + (vehicle.is_moving ? " moving" : " standing"));
}

std::vector<std::string> Judge::look(const std::vector<Vehicle>& vehicles, const std::vector<Thing>& things, const grid::OccupancyGrid& walls,
                                     const grid::ClearanceField& clearance, Result& result) {
  std::vector<std::string> lines;
  for (const Vehicle& a : vehicles) {
    const Point2 p = a.base_in_map.position();
    if (clearance.clearance_m(p) < a.radius_m + 0.3) pair(a, "wall", distance_to_walls_m(walls, p) - a.radius_m, result, lines);
    for (const Thing& thing : things) pair(a, thing.id, geometry::distance_m(thing.body, p) - a.radius_m, result, lines);
    for (const Vehicle& b : vehicles)
      if (&a != &b) pair(a, b.id, geometry::distance(p, b.base_in_map.position()) - a.radius_m - b.radius_m, result, lines);
  }
  return lines;
}

}  // namespace aisle::lockstep
