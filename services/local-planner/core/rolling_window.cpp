#include "services/local-planner/core/rolling_window.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kStepM = 0.2;     // along the route
constexpr double kLeastMps = 0.4;  // at which a vehicle that stands is expected to drive on
constexpr double kLeastWindowM = 0.5;
constexpr double kWindowShares[] = {1.0, 0.7, 0.5, 0.35, 0.25, 0.15};  // of the largest window, tried in this order
constexpr double kLongestGrowthS = 1.0;                                // a margin does not grow for longer
constexpr double kDirectionRad = 0.08;                                 // apart are the directions looked in,
constexpr int kDirections = 10;                                        // so many to each side of the route's,
constexpr double kMostTurnRad = 0.8;  // none so far from the heading that the vehicle would stop to turn there
constexpr double kAlongCosine = 0.7;  // of the angle between two directions that count as one line

/// By the angle between the two velocities.
Encounter kind_of(Point2 own_velocity, Point2 its_velocity) {
  const double own = geometry::norm(own_velocity);
  const double its = geometry::norm(its_velocity);

  if (its < kStandingMps) return Encounter::kStatic;
  if (own < kStandingMps) return Encounter::kCrossing;

  const double cosine = geometry::dot(own_velocity, its_velocity) / (own * its);
  return cosine < -kAlongCosine  ? Encounter::kOncoming
         : cosine > kAlongCosine ? Encounter::kOvertaking
                                 : Encounter::kCrossing;
}

}  // namespace

const char* name(Encounter encounter) {
  switch (encounter) {
    case Encounter::kStatic:
      return "standing";
    case Encounter::kOncoming:
      return "oncoming";
    case Encounter::kCrossing:
      return "crossing";
    case Encounter::kOvertaking:
      return "slower";
    case Encounter::kNone:
      break;
  }

  return "none";
}

Approach closest_approach(Point2 relative_position, Point2 relative_velocity, double horizon_s) {
  // The time at which |p + u t| is least.
  const double speed2 = geometry::dot(relative_velocity, relative_velocity);
  const double time_s =
      speed2 > 0.0 ? std::clamp(-geometry::dot(relative_position, relative_velocity) / speed2, 0.0, horizon_s) : 0.0;

  return {time_s, geometry::norm(relative_position + time_s * relative_velocity)};
}

// Straight on at the present speed; of all that comes too near, the one that comes first.
Meeting predict_meeting(const Scene& scene, double window_m, double horizon_s) {
  const Point2 here = scene.base_in_map.position();
  const double yaw = scene.base_in_map.yaw;
  const Point2 velocity = scene.twist.linear_mps * Point2{std::cos(yaw), std::sin(yaw)};

  Meeting first;
  for (const Mover& mover : scene.movers) {
    const Point2 p = mover.position_in_map - here;
    if (geometry::norm(p) > window_m) continue;

    const Approach approach = closest_approach(p, mover.velocity_in_map - velocity, horizon_s);
    const double needed_m = scene.radius_m + mover.radius_m + mover.margin_m +
                            mover.growth_mps * std::min(approach.time_s, kLongestGrowthS);

    if (approach.distance_m >= needed_m) continue;
    if (first.encounter != Encounter::kNone && approach.time_s >= first.approach.time_s) continue;

    first = {kind_of(velocity, mover.velocity_in_map), approach,
             mover.position_in_map + approach.time_s * mover.velocity_in_map};
  }

  return first;
}

namespace {

/// What would be met straight on in this direction, at a speed at which a standing vehicle would set off.
Meeting predict_towards(const Window& window, double bearing_rad) {
  Scene towards = window.scene;
  towards.base_in_map.yaw = bearing_rad;
  towards.twist = {std::max(kLeastMps, window.scene.twist.linear_mps), 0.0, 0.0};

  return predict_meeting(towards, window.radius_m, window.horizon_s);
}

/// The route's last point before it leaves the disc.
Point2 exit_in_map(const Window& window, double radius_m) {
  const Point2 here = window.scene.base_in_map.position();
  const double end_m = window.route.length_m();

  double s = window.s_m;
  while (s < end_m && geometry::distance(window.route.at(s + kStepM), here) <= radius_m) s += kStepM;

  return window.route.at(s);
}

}  // namespace

std::optional<Point2> local_sub_target(const Window& window) {
  const Point2 here = window.scene.base_in_map.position();
  const double goal_m = geometry::distance(window.route.points().back(), here);
  for (const double share : kWindowShares) {
    const Point2 exit = exit_in_map(window, share * std::min(window.radius_m, std::max(goal_m, kLeastWindowM)));
    for (int i = 0; i <= 2 * kDirections; ++i) {  // straight at it, then ever farther to either side
      const double bearing = geometry::bearing(here, exit) + (i % 2 == 0 ? i / 2 : -(i + 1) / 2) * kDirectionRad;
      if (std::abs(geometry::wrap(bearing - window.scene.base_in_map.yaw)) > kMostTurnRad) continue;
      if (predict_towards(window, bearing).encounter != Encounter::kNone) continue;

      const Point2 p = here + geometry::distance(here, exit) * Point2{std::cos(bearing), std::sin(bearing)};
      if (window.room.is_line_free(here, p)) return p;
    }
  }

  return std::nullopt;
}

Meeting meeting_towards(const Window& window, Point2 target_in_map) {
  return predict_towards(window, geometry::bearing(window.scene.base_in_map.position(), target_in_map));
}

std::optional<Point2> avoid(const Window& window, Point2 path_target_in_map) {
  const Encounter met = meeting_towards(window, path_target_in_map).encounter;
  if (met == Encounter::kNone || met == Encounter::kOvertaking) return std::nullopt;
  return local_sub_target(window);
}

}  // namespace aisle::local_planner
