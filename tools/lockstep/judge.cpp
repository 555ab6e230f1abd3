#include "tools/lockstep/judge.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/separation.hpp"

namespace aisle::lockstep {
namespace {

using geometry::Point2;

constexpr double kTouchM = 0.001;  // a simulated vehicle is stopped just before it overlaps
constexpr double kApartM = 0.02;
constexpr double kNearM = 0.3;  // contacts with walls are looked for from here on
constexpr double kLookM = 2.0;  // the least clearance is not looked for beyond

}  // namespace

double gap_to_walls_m(const grid::OccupancyGrid& walls, const geometry::Body& body, double look_m) {
  const grid::Geometry& g = walls.geometry();
  const Point2 p = body.base_in_map.position();
  const grid::Cell c = g.cell_at(p);
  const bool is_disc = body.shape == geometry::Body::Shape::kDisc;
  const int reach = static_cast<int>(std::ceil((look_m + geometry::reach_m(body)) / g.resolution_m));
  double least = look_m + (is_disc ? body.radius_m : 0.0);
  for (int y = c.y - reach; y <= c.y + reach; ++y)
    for (int x = c.x - reach; x <= c.x + reach; ++x) {
      if (walls.is_free({x, y})) continue;
      const Point2 center = g.center_in_map({x, y});
      if (!is_disc) {
        least = std::min(
            least,
            geometry::separation_m(
                body,
                {geometry::Body::Shape::kRectangle, {center.x, center.y, 0.0}, 0.0, g.resolution_m, g.resolution_m}));
        continue;
      }
      const Point2 d = p - center;
      const double half = 0.5 * g.resolution_m;
      least = std::min(least, std::hypot(std::max(0.0, std::abs(d.x) - half), std::max(0.0, std::abs(d.y) - half)));
    }
  return is_disc ? least - body.radius_m : least;
}

void Judge::pair(const JudgedVehicle& vehicle, const std::string& other, double gap_m, Result& result,
                 std::vector<Touch>& touches) {
  if (vehicle.is_moving && gap_m < kLookM) result.least_clearance_m = std::min(result.least_clearance_m, gap_m);
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
  if (begins || begins_moving)
    touches.push_back({0.0, vehicle.id, other, vehicle.body.base_in_map.position(), begins, vehicle.is_moving});
}

std::vector<Touch> Judge::look(const std::vector<JudgedVehicle>& vehicles, const std::vector<Thing>& things,
                               const grid::OccupancyGrid& walls, const grid::ClearanceField& clearance,
                               Result& result) {
  std::vector<Touch> touches;
  for (const JudgedVehicle& a : vehicles) {
    const double at_least_m = clearance.clearance_m(a.body.base_in_map.position()) - geometry::reach_m(a.body) -
                              walls.geometry().resolution_m;
    const double asked_m = std::max(kNearM, a.is_moving ? std::min(result.least_clearance_m, kLookM) : 0.0);
    const double gap_m = at_least_m < asked_m ? gap_to_walls_m(walls, a.body, asked_m) : asked_m;
    if (gap_m < asked_m) pair(a, "wall", gap_m, result, touches);
    for (const Thing& thing : things) pair(a, thing.id, geometry::separation_m(a.body, thing.body), result, touches);
    for (const JudgedVehicle& b : vehicles)
      if (&a != &b) pair(a, b.id, geometry::separation_m(a.body, b.body), result, touches);
  }
  return touches;
}

}  // namespace aisle::lockstep
