#include "services/local-planner/core/target.hpp"

#include <algorithm>
#include <cmath>

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
constexpr double kSamePointM = 0.01;
constexpr double kTubeShare =
    0.5;  // of its half width: so far the way may bend away from the straight line to a target
constexpr double kTubeStepM = 0.15;
constexpr double kMoverCapInTubeM = 0.1;

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

/// Does the straight line to the way's point so far ahead keep to the tube, as far as the vehicle itself does?
bool is_in_tube(const OnWay& on_way, double ahead_m) {
  if (on_way.tube == nullptr || !on_way.moment.vehicle.turns_on_the_spot()) return true;

  const Point2 here = on_way.moment.here();
  const double s_m = on_way.way.s_m();
  const Point2 target = on_way.way.current().at(s_m + ahead_m);
  const std::vector<Point2> path = on_way.way.current().part(s_m, s_m + ahead_m);
  const auto off_m = [&](Point2 p) { return off_path_m(path, {p.x, p.y, 0.0}, {}, true); };
  const double most_m = std::max(off_m(here), kTubeShare * on_way.tube->half_width_m);

  const int pieces = static_cast<int>(std::ceil(ahead_m / kTubeStepM));
  for (int i = 1; i < pieces; ++i)
    if (off_m(here + (static_cast<double>(i) / pieces) * (target - here)) > most_m) return false;

  return true;
}

/// The way's point so far ahead; where that is near, as before the way's end and before a turn on the spot, a point
/// straight on behind it: so the last piece is driven straight.
Point2 target_in_tube(const OnWay& on_way, double ahead_m) {
  const Route& route = on_way.way.current();
  const double s_m = on_way.way.s_m();
  const double at_m = std::min({s_m + std::max(ahead_m, kLeastTargetM), on_way.most_m, route.length_m()});
  const double beyond_m = std::max(0.0, s_m + kShortestM - at_m);
  const double leg_m = std::clamp(at_m - s_m, kSamePointM, kLeastTargetM);  // none before where the vehicle is
  const double yaw = route.heading_at(std::max(0.0, at_m - leg_m));

  return route.at(at_m) + beyond_m * Point2{std::cos(yaw), std::sin(yaw)};
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
  const bool is_straight_to_goal = !knows_path && on_way.tube == nullptr && !way.backs_off();
  if (is_straight_to_goal) return route.points().back();

  const double s_m = way.s_m();
  const double wanted_m =
      std::clamp(kLookAheadM + kLookAheadS * on_way.in_force.linear_mps, kLeastLookAheadM, kMostLookAheadM);
  const Room room = on_way.moment.room(on_way.around, kSightMarginM, kSightMarginM);

  // Nearer and nearer, until it is in sight.
  double ahead_m = std::min({wanted_m, route.length_m() - s_m, on_way.most_m - s_m});
  const auto is_in_sight = [&](double ahead) {
    return on_way.tube != nullptr ? is_in_tube(on_way, ahead)
                                  : room.is_line_free(on_way.moment.here(), route.at(s_m + ahead));
  };
  while (ahead_m > kShortestM && !is_in_sight(ahead_m)) ahead_m -= kShorterM;

  return on_way.tube != nullptr ? target_in_tube(on_way, ahead_m) : route.at(s_m + std::max(ahead_m, kLeastTargetM));
}

std::optional<Point2> sub_target_beside(const OnWay& on_way, const Scene& scene, Point2 target_in_map) {
  if (on_way.way.backs_off() || on_way.tube != nullptr || !on_way.moment.vehicle.turns_on_the_spot())
    return std::nullopt;
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
  const double nearest_m = way.s_near_m(then, on_way.most_m);

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
  if (on_way.tube != nullptr) {
    // There is no room to make more of: what leads along the way is all that counts.
    aim.mover_cap_m = kMoverCapInTubeM;
    aim.wall_cap_m = settings.wall_margin_m;
  }
  if (variant.asks_for(path_distance_critic))
    aim.path_in_map = points_ahead(route, nearest_m, on_way.moment.vehicle.limits.max_speed_mps * settings.horizon_s);
  return aim;
}

}  // namespace aisle::local_planner
