#include "tools/lab/traffic/floor_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/geometry/separation.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;

constexpr double kSampleM = 0.1;    // along a road
constexpr double kOffRoadM = 0.25;  // the middle of an arc at a right angle lies 0.21 m off its corner
constexpr double kRoundingM = 0.01;
constexpr double kGridM = 0.05;  // what a map of cells may be off

/// The discs that a vehicle covers along its roads, with the box around their middles.
struct Swept {
  double radius_m{0.0};
  std::vector<Point2> middles;
  Point2 low{1e9, 1e9}, high{-1e9, -1e9};

  void add(Point2 p) {
    middles.push_back(p);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// The outline's discs at every tenth of a metre of the roads, in the direction of driving. A rectangle's discs are as
/// wide as the rectangle: what they leave out at the corners is not judged.
Swept swept_by(const JudgedVehicle& vehicle) {
  const geometry::CoveringDiscs discs = geometry::covering_discs(vehicle.footprint);
  Swept swept;
  swept.radius_m = vehicle.footprint.is_disc() ? vehicle.footprint.radius_m : 0.5 * vehicle.footprint.width_m;

  const auto stamp = [&](const geometry::Pose2& at) {
    for (const double ahead : discs.ahead_m) swept.add(geometry::to_map(at, {ahead, 0.0}));
  };

  stamp(vehicle.base_in_map);

  for (const std::vector<Point2>& road : vehicle.roads_in_map) {
    for (std::size_t i = 1; i < road.size(); ++i) {
      const double length = geometry::distance(road[i - 1], road[i]);
      double yaw = geometry::bearing(road[i - 1], road[i]);

      // A vehicle that drives back keeps its heading.
      if (!vehicle.footprint.is_disc() && std::abs(geometry::wrap(yaw - vehicle.base_in_map.yaw)) > 1.6)
        yaw = geometry::wrap(yaw + geometry::kPi);

      for (double s = 0.0; s <= length; s += kSampleM) {
        const Point2 at = road[i - 1] + (length > 0.0 ? s / length : 0.0) * (road[i] - road[i - 1]);
        stamp({at.x, at.y, yaw});
      }
    }
  }

  return swept;
}

/// Do discs of the two overlap? Where, if so.
bool overlap(const Swept& a, const Swept& b, Point2& where) {
  const double reach = a.radius_m + b.radius_m - kRoundingM;
  if (a.low.x > b.high.x + reach || b.low.x > a.high.x + reach) return false;
  if (a.low.y > b.high.y + reach || b.low.y > a.high.y + reach) return false;

  for (const Point2 p : a.middles) {
    if (p.x < b.low.x - reach || p.x > b.high.x + reach || p.y < b.low.y - reach || p.y > b.high.y + reach) continue;

    for (const Point2 q : b.middles) {
      if (geometry::dot(p - q, p - q) >= reach * reach) continue;

      where = p;
      return true;
    }
  }

  return false;
}

}  // namespace

void FloorJudge::note(bool is_so, const Pair& pair, std::set<Pair>& open, int& count, const std::string& line) {
  if (!is_so) {
    open.erase(pair);
    return;
  }

  if (!open.insert(pair).second) return;

  ++count;
  findings_.push_back(line);
}

void FloorJudge::judge_bodies(double now_s, const std::vector<JudgedVehicle>& vehicles) {
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    const JudgedVehicle& a = vehicles[i];
    const geometry::Body body_a = geometry::body_of(a.footprint, a.base_in_map);

    for (std::size_t k = i + 1; k < vehicles.size(); ++k) {
      const JudgedVehicle& b = vehicles[k];
      const double middles_m = geometry::distance(a.base_in_map.position(), b.base_in_map.position());
      const bool is_far = middles_m > geometry::reach_m(a.footprint) + geometry::reach_m(b.footprint) + 1.0;
      const double gap_m = is_far ? 1.0 : geometry::separation_m(body_a, geometry::body_of(b.footprint, b.base_in_map));

      least_clearance_m_ = std::min(least_clearance_m_, gap_m);
      note(gap_m < 0.0, {a.agv_id, b.agv_id}, touching_, contacts_,
           gap_m < 0.0 ? fmt::format("{:.1f} s: {} touches {} at ({:.2f}, {:.2f})", now_s, a.agv_id, b.agv_id,
                                     a.base_in_map.x, a.base_in_map.y)
                       : std::string());
    }
  }
}

void FloorJudge::judge_roads(double now_s, const std::vector<JudgedVehicle>& vehicles) {
  std::vector<Swept> swept;
  for (const JudgedVehicle& vehicle : vehicles) swept.push_back(swept_by(vehicle));

  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    for (std::size_t k = i + 1; k < vehicles.size(); ++k) {
      const Pair pair = std::minmax(vehicles[i].agv_id, vehicles[k].agv_id);
      if (excepted_.count(pair) > 0 || !vehicles[i].obeys || !vehicles[k].obeys) continue;

      Point2 where;
      const bool is_shared = overlap(swept[i], swept[k], where);
      note(is_shared, pair, shared_, held_twice_,
           is_shared ? fmt::format("{:.1f} s: {} and {} both hold ({:.2f}, {:.2f})", now_s, vehicles[i].agv_id,
                                   vehicles[k].agv_id, where.x, where.y)
                     : std::string());
    }
  }
}

void FloorJudge::judge_places(double now_s, const std::vector<JudgedVehicle>& vehicles) {
  for (const JudgedVehicle& vehicle : vehicles) {
    const Point2 at = vehicle.base_in_map.position();
    double off_m = vehicle.granted_in_map.empty() ? 0.0 : std::numeric_limits<double>::infinity();

    for (const std::vector<Point2>& road : vehicle.granted_in_map) {
      if (road.size() == 1) off_m = std::min(off_m, geometry::distance(at, road.front()));
      for (std::size_t i = 1; i < road.size(); ++i)
        off_m = std::min(off_m, geometry::distance_to_segment(at, road[i - 1], road[i]));
    }

    const bool is_off = vehicle.obeys && off_m > kOffRoadM;
    note(is_off, {vehicle.agv_id, ""}, off_, off_road_,
         is_off ? fmt::format("{:.1f} s: {} is {:.2f} m off what was granted, at ({:.2f}, {:.2f})", now_s,
                              vehicle.agv_id, off_m, at.x, at.y)
                : std::string());
  }
}

void FloorJudge::judge_walls(double now_s, const std::vector<JudgedVehicle>& vehicles) {
  for (const JudgedVehicle& vehicle : vehicles) {
    const geometry::CoveringDiscs discs = geometry::covering_discs(vehicle.footprint);
    const double radius = vehicle.footprint.is_disc() ? vehicle.footprint.radius_m : 0.5 * vehicle.footprint.width_m;
    bool is_touching = false;

    for (const double ahead : discs.ahead_m) {
      const Point2 middle = geometry::to_map(vehicle.base_in_map, {ahead, 0.0});
      if (clearance_.clearance_m(middle) < radius - kGridM) is_touching = true;
    }

    note(is_touching, {vehicle.agv_id, ""}, in_walls_, wall_contacts_,
         is_touching ? fmt::format("{:.1f} s: {} touches a wall at ({:.2f}, {:.2f})", now_s, vehicle.agv_id,
                                   vehicle.base_in_map.x, vehicle.base_in_map.y)
                     : std::string());
  }
}

void FloorJudge::look(double now_s, const std::vector<JudgedVehicle>& vehicles) {
  judge_bodies(now_s, vehicles);
  judge_places(now_s, vehicles);
  judge_walls(now_s, vehicles);
  judge_roads(now_s, vehicles);
}

}  // namespace aisle::lab
