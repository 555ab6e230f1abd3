#include "services/local-planner/core/lane.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kStepM = kRouteStepM;
constexpr double kArcStepM = 0.1;        // the same on arcs
constexpr double kSamePointM = 0.01;     // nearer points are one, as for a route
constexpr std::size_t kLeastPoints = 3;  // of a plan that can be relaxed

// Relaxing: each round moves a point by these shares of its bend, of the way to its target, and away from walls.
constexpr int kRounds = 30;
constexpr double kBendShare = 0.35;
constexpr double kTargetShare = 0.04;
constexpr double kWallShare = 0.2;  // of what a point lacks of being roomy
constexpr double kRoundingM = 1e-9;
constexpr double kBetweenPointsM = 0.03;  // between two points the lane may be so much nearer to walls

// Speeds.
constexpr double kBendSpanM = 0.4;       // to both sides, over which curvature is measured,
constexpr double kLeastBendSpanM = 0.3;  // none where the route is shorter
constexpr double kStraight = 1e-3;       // a smaller curvature, in rad/m, is none
constexpr double kTurnShare = 0.6;       // of the turn rate, in bends: the rest corrects
constexpr double kLeastBendMps = 0.15;
constexpr double kOnTheSpotRad = 0.6;  // a sharper turn at one point is made on the spot, where turns are

/// Where clearance grows fastest: the gradient over a short distance to all sides.
Point2 away_from_walls(const grid::ClearanceField& clearance, Point2 p) {
  constexpr double kSpanM = 0.1;
  return (0.5 / kSpanM) *
         Point2{clearance.clearance_m(Point2{p.x + kSpanM, p.y}) - clearance.clearance_m(Point2{p.x - kSpanM, p.y}),
                clearance.clearance_m(Point2{p.x, p.y + kSpanM}) - clearance.clearance_m(Point2{p.x, p.y - kSpanM})};
}

/// Pulls each point towards its neighbours and its own target, and away from walls that are nearer than `roomy`; never
/// closer to walls than `needed` or than it was.
void relax(std::vector<Point2>& points, const std::vector<Point2>& targets, const grid::ClearanceField& clearance,
           double needed_m, double roomy_m) {
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Point2 bend = points[i - 1] + points[i + 1] - 2.0 * points[i];
      const double now = clearance.clearance_m(points[i]);
      Point2 moved = points[i] + kBendShare * bend + kTargetShare * (targets[i] - points[i]);
      if (now < roomy_m) moved = moved + kWallShare * (roomy_m - now) * away_from_walls(clearance, points[i]);
      if (clearance.clearance_m(moved) >= std::min(needed_m, now)) points[i] = moved;
    }
}

/// Is the lane nowhere nearer to walls than the plan, or than `needed_m`? Between two points a little nearer is
/// allowed.
bool is_safe(const std::vector<Point2>& points, const std::vector<Point2>& plan, const grid::ClearanceField& clearance,
             double needed_m) {
  double plan_least = needed_m;
  for (const Point2 p : plan) plan_least = std::min(plan_least, clearance.clearance_m(p));

  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (clearance.clearance_m(points[i]) < plan_least - kRoundingM) return false;
    if (clearance.clearance_m(0.5 * (points[i] + points[i + 1])) < plan_least - kBetweenPointsM) return false;
  }

  return true;
}

/// Appends points of a straight piece every kStepM, without its first one.
void append_straight(Point2 from, double from_plan_m, Point2 to, double to_plan_m, std::vector<Point2>& points,
                     std::vector<double>& plan_m) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(geometry::distance(from, to) / kStepM)));
  for (int i = 1; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    points.push_back(from + share * (to - from));
    plan_m.push_back(from_plan_m + share * (to_plan_m - from_plan_m));
  }
}

/// Appends points of the arc from `begin` to `end`, tangent to both legs of the turn, without its first one.
///
/// How: the radius is arc / tan(|turn| / 2), the centre lies abeam of where the arc begins, on the side that it turns
/// to; at heading y the point on the arc is to the other side of the centre.
void append_arc(Point2 begin, Point2 turn, Point2 end, double turn_plan_m, double arc_m, std::vector<Point2>& points,
                std::vector<double>& plan_m) {
  const double by_rad = geometry::wrap(geometry::bearing(turn, end) - geometry::bearing(begin, turn));
  const double radius_m = arc_m / std::tan(0.5 * std::abs(by_rad));
  const double heading = geometry::bearing(begin, turn);
  const double side = by_rad > 0.0 ? 1.0 : -1.0;
  const Point2 centre = begin + side * radius_m * Point2{-std::sin(heading), std::cos(heading)};

  const int pieces = std::max(2, static_cast<int>(std::ceil(radius_m * std::abs(by_rad) / kArcStepM)));
  for (int i = 1; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const double yaw = heading + share * by_rad;
    points.push_back(centre + side * radius_m * Point2{std::sin(yaw), -std::cos(yaw)});
    plan_m.push_back(turn_plan_m + (2.0 * share - 1.0) * arc_m);
  }
}

/// Is the turn at point i of the route made on the spot?
bool is_on_the_spot(const Route& route, std::size_t i) {
  const double by_rad =
      geometry::wrap(route.heading_at(route.along_m(i)) - route.heading_at(route.along_m(i) - kSamePointM));
  return std::abs(by_rad) > kOnTheSpotRad;
}

/// Where the piece of the route around point i begins and ends that is driven without a turn on the spot; not farther
/// away than a bend is looked at.
double bend_from_m(const Route& route, std::size_t i, bool stops_at_turns) {
  const double s = route.along_m(i);
  for (std::size_t j = i; stops_at_turns && j > 0 && s - route.along_m(j) < kBendSpanM; --j)
    if (is_on_the_spot(route, j)) return route.along_m(j);

  return 0.0;
}

double bend_to_m(const Route& route, std::size_t i, bool stops_at_turns) {
  const double s = route.along_m(i);
  for (std::size_t j = i + 1; stops_at_turns && j + 1 < route.points().size() && route.along_m(j) - s < kBendSpanM; ++j)
    if (is_on_the_spot(route, j)) return route.along_m(j) - kSamePointM;

  return route.length_m();
}

}  // namespace

Lane::Lane(Route plan) : route(std::move(plan)) {
  for (std::size_t i = 0; i < route.points().size(); ++i) plan_m.push_back(route.along_m(i));
}

Lane::Lane(const std::vector<Point2>& points_in_map, const std::vector<double>& points_plan_m) {
  std::vector<Point2> kept;
  for (std::size_t i = 0; i < points_in_map.size(); ++i) {
    if (!kept.empty() && geometry::distance(kept.back(), points_in_map[i]) < kSamePointM) continue;
    kept.push_back(points_in_map[i]);
    plan_m.push_back(points_plan_m[i]);
  }

  if (kept.size() > 1) {
    kept.back() = points_in_map.back();
    plan_m.back() = points_plan_m.back();
  }

  route = Route(kept);
}

double Lane::left_m(double along_plan_m) const {
  if (plan_m.empty()) return 0.0;
  const auto after = std::upper_bound(plan_m.begin(), plan_m.end(), along_plan_m);
  if (after == plan_m.begin()) return route.length_m();
  if (after == plan_m.end()) return 0.0;

  const auto i = static_cast<std::size_t>(std::distance(plan_m.begin(), after));
  const double share = (along_plan_m - plan_m[i - 1]) / (plan_m[i] - plan_m[i - 1]);

  return route.length_m() - route.along_m(i - 1) - share * (route.along_m(i) - route.along_m(i - 1));
}

Lane make_lane(const std::vector<Point2>& waypoints_in_map, const grid::ClearanceField& clearance, double radius_m,
               const LaneSettings& settings) {
  const std::vector<Point2> plan = resample(waypoints_in_map, kStepM);
  const double length_m = Route(waypoints_in_map).length_m();

  std::vector<double> plan_m;
  for (std::size_t i = 0; i < plan.size(); ++i)
    plan_m.push_back(length_m * static_cast<double>(i) /
                     static_cast<double>(std::max<std::size_t>(1, plan.size() - 1)));
  if (plan.size() < kLeastPoints) return {plan, plan_m};

  // Relax, and keep the result only if it is safe.
  const double needed = radius_m + settings.margin_m;
  std::vector<Point2> points = plan;
  relax(points, plan, clearance, needed, radius_m + settings.roomy_m);

  return {is_safe(points, plan, clearance, needed) ? points : plan, plan_m};
}

Lane rounded_lane(const std::vector<RoundedTurn>& turns) {
  if (turns.empty()) return {};
  std::vector<Point2> points{turns.front().in_map};
  std::vector<double> plan_m{0.0};

  double turn_plan_m = 0.0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const Point2 before = turns[i - 1].in_map;
    const Point2 here = turns[i].in_map;
    const double leg_m = geometry::distance(before, here);
    turn_plan_m += leg_m;
    if (leg_m < kSamePointM) continue;

    // Straight on to where the arc begins, or to the turn itself; then the arc.
    const double arc_m = i + 1 < turns.size() ? turns[i].arc_m : 0.0;
    const Point2 begin = here + (arc_m / leg_m) * (before - here);
    append_straight(points.back(), plan_m.back(), begin, turn_plan_m - arc_m, points, plan_m);
    if (arc_m <= 0.0) continue;

    const Point2 after = turns[i + 1].in_map;
    const Point2 end = here + (arc_m / geometry::distance(here, after)) * (after - here);
    append_arc(begin, here, end, turn_plan_m, arc_m, points, plan_m);
  }

  return {points, plan_m};
}

double arc_off_turn_m(double arc_m, double turn_rad) {
  const double half_rad = 0.5 * std::abs(turn_rad);
  return half_rad > 0.0 ? arc_m * (1.0 - std::cos(half_rad)) / std::sin(half_rad) : 0.0;
}

std::vector<double> speed_profile(const Route& route, const grid::ClearanceField& clearance, double radius_m,
                                  const ProfileLimits& limits) {
  const auto& points = route.points();
  std::vector<double> speed(points.size(), limits.max_speed_mps);

  // Each point's own bound.
  for (std::size_t i = 0; limits.slows_on_the_way && i < points.size(); ++i) {
    const double gap = std::max(0.0, clearance.clearance_m(points[i]) - radius_m);
    speed[i] = std::min(speed[i], limits.at_wall_mps + limits.gap_rate * gap);

    const double s = route.along_m(i);
    const double before = std::max(bend_from_m(route, i, limits.stops_at_turns), s - kBendSpanM);
    const double after = std::min(bend_to_m(route, i, limits.stops_at_turns), s + kBendSpanM);
    if (after - before < kLeastBendSpanM) continue;

    // In a bend of curvature k: v^2 k <= lateral, and v k <= turn rate.
    const double turn = std::abs(geometry::wrap(route.heading_at(after) - route.heading_at(before)));
    const double curvature = turn / (after - before);
    if (curvature < kStraight) continue;

    speed[i] = std::min({speed[i], std::sqrt(limits.lateral_mps2 / curvature),
                         std::max(kLeastBendMps, kTurnShare * limits.max_turn_radps / curvature)});
  }

  if (!speed.empty()) speed.back() = 0.0;

  // Braking, from the end backwards.
  for (std::size_t i = speed.size(); i-- > 1;) {
    const double ds = route.along_m(i) - route.along_m(i - 1);
    speed[i - 1] = std::min(speed[i - 1], std::sqrt(speed[i] * speed[i] + 2.0 * limits.comfort_mps2 * ds));
  }

  return speed;
}

}  // namespace aisle::local_planner
