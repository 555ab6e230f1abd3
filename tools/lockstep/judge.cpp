#include "tools/lockstep/judge.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/separation.hpp"

namespace aisle::lockstep {
namespace {

using geometry::Point2;

constexpr double kTouchM = 0.001;        // a simulated vehicle is stopped just before it overlaps
constexpr double kApartM = 0.02;
constexpr double kLookM = 1.0;

/// To the nearest square cell that is not free.
double distance_to_walls_m(const grid::OccupancyGrid& walls, const geometry::Body& body) {
  const grid::Geometry& g = walls.geometry();
  const Point2 p = body.base_in_map.position();
  const grid::Cell c = g.cell_at(p);
  const bool is_disc = body.shape == geometry::Body::Shape::kDisc;
  const int reach = static_cast<int>(std::ceil((kLookM + (is_disc ? 0.0 : geometry::reach_m(body))) / g.resolution_m));
  double least = kLookM;
  for (int y = c.y - reach; y <= c.y + reach; ++y)
    for (int x = c.x - reach; x <= c.x + reach; ++x) {
      if (walls.is_free({x, y})) continue;
      const Point2 center = g.center_in_map({x, y});
      if (!is_disc) {
        least = std::min(least, geometry::separation_m(body, {geometry::Body::Shape::kRectangle, {center.x, center.y, 0.0}, 0.0, g.resolution_m, g.resolution_m}));
        continue;
      }
      const Point2 d = p - center;
      const double half = 0.5 * g.resolution_m;
      least = std::min(least, std::hypot(std::max(0.0, std::abs(d.x) - half), std::max(0.0, std::abs(d.y) - half)));
    }
  return is_disc ? least - body.radius_m : least;
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
    if (clearance.clearance_m(a.body.base_in_map.position()) < geometry::reach_m(a.body) + 0.3) pair(a, "wall", distance_to_walls_m(walls, a.body), result, lines);
    for (const Thing& thing : things) pair(a, thing.id, geometry::separation_m(a.body, thing.body), result, lines);
    for (const Vehicle& b : vehicles)
      if (&a != &b) pair(a, b.id, geometry::separation_m(a.body, b.body), result, lines);
  }
  return lines;
}

}  // namespace aisle::lockstep
