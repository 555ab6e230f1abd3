#include "services/local-planner/core/rolling_window.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kStandingMps = 0.05;
constexpr double kAlongCosine = 0.7;      // of the angle between two directions that count as one line

Encounter kind_of(Point2 own_velocity, Point2 its_velocity) {
  const double own = geometry::norm(own_velocity);
  const double its = geometry::norm(its_velocity);
  if (its < kStandingMps) return Encounter::kStatic;
  if (own < kStandingMps) return Encounter::kCrossing;
  const double cosine = geometry::dot(own_velocity, its_velocity) / (own * its);
  return cosine < -kAlongCosine ? Encounter::kOncoming : cosine > kAlongCosine ? Encounter::kOvertaking : Encounter::kCrossing;
}

}  // namespace

const char* name(Encounter encounter) {
  switch (encounter) {
    case Encounter::kStatic: return "standing";
    case Encounter::kOncoming: return "oncoming";
    case Encounter::kCrossing: return "crossing";
    case Encounter::kOvertaking: return "slower";
    case Encounter::kNone: break;
  }
  return "none";
}

Approach closest_approach(Point2 relative_position, Point2 relative_velocity, double horizon_s) {
  const double speed2 = geometry::dot(relative_velocity, relative_velocity);
  const double time_s = speed2 > 0.0 ? std::clamp(-geometry::dot(relative_position, relative_velocity) / speed2, 0.0, horizon_s) : 0.0;
  return {time_s, geometry::norm(relative_position + time_s * relative_velocity)};
}

Meeting predict_meeting(const Scene& scene, double window_m, double horizon_s) {
  const Point2 here = scene.base_in_map.position();
  const double yaw = scene.base_in_map.yaw;
  const Point2 velocity = scene.twist.linear_mps * Point2{std::cos(yaw), std::sin(yaw)};
  Meeting first;
  for (const Mover& mover : scene.movers) {
    const Point2 p = mover.position_in_map - here;
    if (geometry::norm(p) > window_m) continue;
    const Approach approach = closest_approach(p, mover.velocity_in_map - velocity, horizon_s);
    const double needed_m = scene.radius_m + mover.radius_m + mover.margin_m + mover.growth_mps * std::min(approach.time_s, 1.0);
    if (approach.distance_m >= needed_m) continue;
    if (first.encounter != Encounter::kNone && approach.time_s >= first.approach.time_s) continue;
    first = {kind_of(velocity, mover.velocity_in_map), approach, mover.position_in_map + approach.time_s * mover.velocity_in_map};
  }
  return first;
}

Point2 local_sub_target(const Route& route, double s_m, Point2 here_in_map, double window_m) {
  if (geometry::distance(route.points().back(), here_in_map) <= window_m) return route.points().back();
  Point2 target = route.at(s_m);
  for (double s = s_m; s <= route.length_m(); s += 0.2) {
    if (geometry::distance(route.at(s), here_in_map) > window_m) break;
    target = route.at(s);
  }
  return target;
}

}  // namespace aisle::local_planner
