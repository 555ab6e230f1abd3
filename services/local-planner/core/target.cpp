#include "services/local-planner/core/target.hpp"

#include <algorithm>

#include "services/local-planner/core/rolling_window.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

// Where the target lies: look-ahead = 0.6 m + 0.9 s * speed, within bounds.
constexpr double kLookAheadM = 0.6;
constexpr double kLookAheadS = 0.9;
constexpr double kLeastLookAheadM = 0.7;
constexpr double kMostLookAheadM = 1.8;
constexpr double kShorterM = 0.2;       // at a time, where it is not in sight,
constexpr double kShortestM = 0.35;     // down to this
constexpr double kLeastTargetM = 0.2;   // ahead, also before the way's end
constexpr double kSightMarginM = 0.02;  // of the straight way to it, from walls and discs

constexpr double kSubTargetM = 0.6;        // LI's look-ahead on the path
constexpr double kPathStepM = 0.2;         // between the points that path distance is measured to
constexpr double kSpareStepM = 0.1;        // between the points whose room is looked at,
constexpr double kLeastSpareAheadM = 1.0;  // so far on at least
constexpr double kRoundingM = 1e-9;

/// Between the walls and the vehicle on its way, from `s_m` to the horizon; at most `most_m`.
double least_spare_m(const OnWay& on_way, double s_m, double horizon_s, double most_m) {
  const Route& route = on_way.way.current();
  const double ahead_m = std::max(kLeastSpareAheadM, on_way.in_force.linear_mps * horizon_s);
  const double end_m = std::min(route.length_m(), s_m + ahead_m);

  double least_m = most_m;

  for (double s = s_m; s <= end_m + kRoundingM; s += kSpareStepM)
    least_m =
        std::min(least_m, on_way.moment.inputs.clearance->clearance_m(route.at(s)) - on_way.moment.discs.radius_m);

  return least_m;
}

}  // namespace

Target target_at(Point2 in_map, const OwnMotion& motion) {
  const geometry::Pose2& then = motion.base_then;
  return {in_map, geometry::wrap(geometry::bearing(then.position(), in_map) - then.yaw),
          geometry::distance(then.position(), in_map)};
}

Point2 target_in_sight(const OnWay& on_way, bool knows_path) {
  const Way& way = on_way.way;
  const Route& route = way.current();
  if (!knows_path && !way.is_aside()) return route.points().back();

  const double s_m = way.s_m();
  const double wanted_m =
      std::clamp(kLookAheadM + kLookAheadS * on_way.in_force.linear_mps, kLeastLookAheadM, kMostLookAheadM);
  const Room room = on_way.moment.room(on_way.around, kSightMarginM, kSightMarginM);

  // Nearer and nearer, until it is in sight.
  double ahead_m = std::min(wanted_m, route.length_m() - s_m);
  while (ahead_m > kShortestM && !room.is_line_free(on_way.moment.here(), route.at(s_m + ahead_m)))
    ahead_m -= kShorterM;

  return route.at(s_m + std::max(ahead_m, kLeastTargetM));
}

std::optional<Point2> sub_target_beside(const OnWay& on_way, const Scene& scene, Point2 target_in_map) {
  if (on_way.way.is_aside() || !on_way.moment.vehicle.turns_on_the_spot()) return std::nullopt;
  const Room room = on_way.moment.room(on_way.around, kSightMarginM, kSightMarginM);

  return avoid({scene, room, on_way.way.current(), on_way.way.s_m()}, target_in_map);
}

std::vector<Point2> points_ahead(const Route& route, double s_m, double ahead_m) {
  std::vector<Point2> points;
  const double end_m = std::min(route.length_m(), s_m + ahead_m);
  for (double s = s_m; s <= end_m + kRoundingM; s += kPathStepM) points.push_back(route.at(s));
  return points;
}

Aim aim_at(Point2 target_in_map, const OnWay& on_way, const Variant& variant, const DwaSettings& settings) {
  const Point2 then = on_way.moment.motion.base_then.position();
  const Way& way = on_way.way;
  const Route& route = way.current();
  const double nearest_m = way.s_near_m(then);

  Aim aim;
  aim.target_in_map = target_in_map;
  aim.sub_target_in_map = route.at(nearest_m + kSubTargetM);
  aim.radius_m = on_way.moment.vehicle.reach_m();
  aim.step_s = settings.step_s;

  if (variant.knows_path) {
    const double to_target_m = geometry::distance(then, target_in_map);
    aim.walls_s = to_target_m / std::max(kStandingMps, on_way.in_force.linear_mps) + settings.window_s;
    aim.wall_cap_m =
        std::max(settings.wall_margin_m, least_spare_m(on_way, nearest_m, settings.horizon_s, aim.wall_cap_m));
  }
  if (variant.asks_for(path_distance_critic))
    aim.path_in_map = points_ahead(route, nearest_m, on_way.moment.vehicle.limits.max_speed_mps * settings.horizon_s);
  return aim;
}

}  // namespace aisle::local_planner
