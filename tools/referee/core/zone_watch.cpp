#include "tools/referee/core/zone_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace aisle::referee {
namespace {

using fleet::Zone;
using geometry::Point2;

constexpr double kPast_s = 0.3;  // over which speed is measured
constexpr double kStandingMps = 0.02;
constexpr double kStandingRadps = 0.05;  // a vehicle that turns on the spot does not stand

}  // namespace

void ZoneWatch::zones_seen(const std::vector<Zone>& zones) {
  const std::vector<Zone> before = std::exchange(zones_, zones);

  // A zone that is new, or another one by the same name, is looked at anew.
  for (auto& [agv_id, vehicle] : vehicles_) {
    for (auto known = vehicle.known.begin(); known != vehicle.known.end();) {
      const auto is_it = [&](const Zone& zone) { return zone.id == *known; };
      const auto now = std::find_if(zones.begin(), zones.end(), is_it);
      const auto then = std::find_if(before.begin(), before.end(), is_it);
      const bool is_same = now != zones.end() && then != before.end() && *now == *then;
      if (!is_same) vehicle.stays.erase(*known);
      known = is_same ? std::next(known) : vehicle.known.erase(known);
    }
  }
}

/// How: of a rectangle the sides of its core are looked at, and whether the zone lies within.
bool ZoneWatch::is_in(const Zone& zone, const BodySample& sample) {
  const Shape& shape = sample.shape;
  const geometry::Pose2 middle = middle_in_map(sample.base_in_map, sample.ahead_m);
  if (shape.is_disc()) {
    const Point2 at = middle.position();
    return fleet::distance_m(zone, at, at) < shape.radius_m - kTouch_m;
  }

  const double half_length_m = std::max(0.0, 0.5 * shape.length_m + shape.radius_m - kTouch_m);
  const double half_width_m = std::max(0.0, 0.5 * shape.width_m + shape.radius_m - kTouch_m);
  const std::array<Point2, 4> corners{geometry::to_map(middle, {half_length_m, half_width_m}),
                                      geometry::to_map(middle, {-half_length_m, half_width_m}),
                                      geometry::to_map(middle, {-half_length_m, -half_width_m}),
                                      geometry::to_map(middle, {half_length_m, -half_width_m})};
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (fleet::distance_m(zone, corners[i], corners[(i + 1) % corners.size()]) <= 0.0) return true;

  const Point2 inside = geometry::from_map(middle, zone.points_in_map.front());
  return std::abs(inside.x) < half_length_m && std::abs(inside.y) < half_width_m;
}

double ZoneWatch::speed_mps(const Watched& vehicle) {
  const BodySample &first = vehicle.past.front(), &last = vehicle.past.back();
  const double passed_s = last.t_s - first.t_s;
  if (passed_s < 0.5 * kPast_s) return 0.0;

  return geometry::distance(first.base_in_map.position(), last.base_in_map.position()) / passed_s;
}

void ZoneWatch::body_seen(const BodySample& sample) {
  if (zones_.empty()) return;
  if (sample.kind != BodyKind::kVehicle) {
    others_[sample.id] = sample;
    return;
  }

  Watched& vehicle = vehicles_[sample.id];
  if (!vehicle.past.empty() && vehicle.past.back().boot_id != sample.boot_id) vehicle = {};
  vehicle.past.push_back(sample);
  while (vehicle.past.back().t_s - vehicle.past.front().t_s > kPast_s) vehicle.past.pop_front();

  const BodySample& then = vehicle.past.front();
  const double passed_s = std::max(1e-3, sample.t_s - then.t_s);
  const double turned_rad = std::abs(geometry::wrap(sample.base_in_map.yaw - then.base_in_map.yaw));
  if (speed_mps(vehicle) > kStandingMps || turned_rad / passed_s > kStandingRadps) vehicle.stands_since_s = sample.t_s;

  for (const Zone& zone : zones_) {
    const bool is_first = vehicle.known.insert(zone.id).second;
    if (!is_in(zone, sample)) {
      vehicle.stays.erase(zone.id);
      continue;
    }

    Stay& stay = vehicle.stays.try_emplace(zone.id, Stay{}).first->second;
    stay.is_excused = stay.is_excused || is_first;
    judge(zone, sample.id, vehicle, stay);
  }
}

bool ZoneWatch::is_before_something(const BodySample& sample) const {
  return std::any_of(others_.begin(), others_.end(), [&](const auto& other) {
    const BodySample& it = other.second;
    const double apart_m = geometry::distance(it.base_in_map.position(), sample.base_in_map.position());
    return apart_m < it.shape.reach_m() + sample.shape.reach_m() + kBefore_m;
  });
}

std::string ZoneWatch::breach_of(const Zone& zone, const std::string& agv_id, const Watched& vehicle,
                                 Stay& stay) const {
  const BodySample& now = vehicle.past.back();

  switch (zone.kind) {
    case Zone::Kind::kKeepOut:
      return "enters";

    case Zone::Kind::kSpeed: {
      const double mps = speed_mps(vehicle);
      if (mps <= zone.max_speed_mps + kFaster_mps) {
        stay.fast_since_s = -1.0;
      } else if (stay.fast_since_s < 0.0) {
        stay.fast_since_s = now.t_s;
      }
      const bool is_fast = stay.fast_since_s >= 0.0 && now.t_s >= stay.fast_since_s + kFast_s;
      return is_fast ? fmt::format("drives {:.2f} m/s, allowed are {:.2f} m/s, in", mps, zone.max_speed_mps) : "";
    }

    case Zone::Kind::kOneWay: {
      const Point2 base = now.base_in_map.position();
      if (!fleet::contains(zone, base)) {
        stay.farthest_m = -1e9;
        return {};
      }
      const double along_m = geometry::dot({std::cos(zone.direction_rad), std::sin(zone.direction_rad)}, base);
      stay.farthest_m = std::max(stay.farthest_m, along_m);
      return along_m < stay.farthest_m - kBack_m ? "drives the wrong way in" : "";
    }

    case Zone::Kind::kNoStopping:
      return now.t_s >= vehicle.stands_since_s + kStands_s && !is_before_something(now) ? "stands in" : "";

    case Zone::Kind::kOneVehicle:
      for (const auto& [other_id, other] : vehicles_) {
        if (other_id != agv_id && other.stays.count(zone.id) > 0) return fmt::format("is beside {} in", other_id);
      }
      return {};

    case Zone::Kind::kParking:
      break;
  }

  return {};
}

void ZoneWatch::judge(const Zone& zone, const std::string& agv_id, Watched& vehicle, Stay& stay) {
  if (stay.is_excused || stay.is_told) return;

  const std::string breach = breach_of(zone, agv_id, vehicle, stay);
  if (breach.empty()) return;

  stay.is_told = true;
  const BodySample& now = vehicle.past.back();
  violations_.push_back({AuthorityViolation::Kind::kZoneBreached, agv_id, now.t_s,
                         fmt::format("{} the {} zone {} at ({:.2f}, {:.2f})", breach, name(zone.kind), zone.id,
                                     now.base_in_map.x, now.base_in_map.y)});
}

}  // namespace aisle::referee
