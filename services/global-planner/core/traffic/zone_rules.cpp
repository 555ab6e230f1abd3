#include "services/global-planner/core/traffic/zone_rules.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

using fleet::Zone;
using geometry::Point2;

// Ways of the lattice that lead straight across a one-way zone are not quite straight: 1 degree.
constexpr double kStraightAcross = 0.0175;

}  // namespace

Box box_around(const Zone& zone) {
  const std::vector<Point2> corners = fleet::corners_of(zone);
  Box box{corners.front(), corners.front()};
  for (const Point2 corner : corners) {
    box.low_in_map = {std::min(box.low_in_map.x, corner.x), std::min(box.low_in_map.y, corner.y)};
    box.high_in_map = {std::max(box.high_in_map.x, corner.x), std::max(box.high_in_map.y, corner.y)};
  }

  return box;
}

bool meets(const Zone& zone, const Shape& shape) {
  return std::any_of(shape.capsules().begin(), shape.capsules().end(), [&](const Capsule& capsule) {
    const double distance_m = fleet::distance_m(zone, capsule.from_in_map, capsule.to_in_map);
    return distance_m < capsule.radius_m;
  });
}

bool goes_against(const Zone& zone, const std::vector<Point2>& path_in_map) {
  if (zone.kind != Zone::Kind::kOneWay) return false;

  const Point2 direction{std::cos(zone.direction_rad), std::sin(zone.direction_rad)};
  for (std::size_t i = 1; i < path_in_map.size(); ++i) {
    const Point2 from = path_in_map[i - 1], to = path_in_map[i];
    const double along_m = geometry::dot(direction, to - from);
    if (along_m < -kStraightAcross * geometry::distance(from, to) && fleet::distance_m(zone, from, to) <= 0.0)
      return true;
  }

  return false;
}

ZoneRules::ZoneRules(std::vector<Zone> zones) : zones_(std::move(zones)) {
  for (const Zone& zone : zones_) boxes_.push_back(box_around(zone));
}

template <class Visit>
void ZoneRules::each_met(Zone::Kind kind, const Shape& shape, Visit&& visit) const {
  for (std::size_t i = 0; i < zones_.size(); ++i)
    if (zones_[i].kind == kind && touch(boxes_[i], shape.box()) && meets(zones_[i], shape)) visit(zones_[i]);
}

bool ZoneRules::forbid_stopping(const Shape& standing) const {
  bool is_met = false;
  each_met(Zone::Kind::kNoStopping, standing, [&](const Zone&) { is_met = true; });
  return is_met;
}

bool ZoneRules::forbid_resting(const Shape& standing) const {
  bool is_met = forbid_stopping(standing);
  each_met(Zone::Kind::kOneVehicle, standing, [&](const Zone&) { is_met = true; });
  return is_met;
}

bool ZoneRules::is_parking(Point2 at_in_map) const {
  return std::any_of(zones_.begin(), zones_.end(), [&](const Zone& zone) {
    return zone.kind == Zone::Kind::kParking && fleet::contains(zone, at_in_map);
  });
}

bool ZoneRules::has_parking() const {
  return std::any_of(zones_.begin(), zones_.end(), [](const Zone& zone) { return zone.kind == Zone::Kind::kParking; });
}

bool ZoneRules::forbid_way(const std::vector<Point2>& path_in_map) const {
  return std::any_of(zones_.begin(), zones_.end(), [&](const Zone& zone) { return goes_against(zone, path_in_map); });
}

double ZoneRules::speed_mps(const Shape& swept, double most_mps) const {
  each_met(Zone::Kind::kSpeed, swept, [&](const Zone& zone) { most_mps = std::min(most_mps, zone.max_speed_mps); });
  return most_mps;
}

Shape ZoneRules::held(Shape shape) const {
  std::vector<Capsule> more;
  each_met(Zone::Kind::kOneVehicle, shape, [&](const Zone& zone) {
    const Point2 at = zone.points_in_map.front();
    more.push_back({at, at, 0.0});
  });

  if (!more.empty()) shape.add(Shape(std::move(more)));
  return shape;
}

}  // namespace aisle::global_planner::traffic
