#include "tools/lockstep/judge.hpp"

#include <algorithm>

#include "common/geometry/separation.hpp"

namespace aisle::lockstep {
namespace {

constexpr double kTouchM = 0.001;  // a simulated vehicle is stopped just before it overlaps
constexpr double kApartM = 0.02;
constexpr double kNearM = 0.3;  // contacts with walls are looked for from here on
constexpr double kLookM = 2.0;  // the least clearance is not looked for beyond

}  // namespace

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
