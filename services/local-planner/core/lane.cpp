#include "services/local-planner/core/lane.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kStepM = kRouteStepM;
constexpr double kReachM = 2.6;          // how far to both sides the aisle is measured
constexpr double kSlope = 0.4;           // metres of shift a metre of way
constexpr std::size_t kLeastPoints = 3;  // of a plan that can be shifted
constexpr int kTangentSpan = 3;          // points to both sides
constexpr double kReachStepM = 0.1;
constexpr double kMostToMiddleM = 0.3;  // of shift, where two cannot pass
constexpr double kQuarter = 0.25;       // of the aisle's width: the middle of its right half
constexpr std::size_t kMeanSpan = 4;    // points to both sides: the shifts of all are averaged
constexpr double kLeastShiftM = 0.02;   // a smaller one is none
constexpr double kShiftShrinks = 0.7;   // at a time, where the shifted point is too near to walls

// Relaxing: each round moves a point by these shares of its bend and of the way to its target.
constexpr int kRounds = 30;
constexpr double kBendShare = 0.35;
constexpr double kTargetShare = 0.04;
constexpr double kRoundingM = 1e-9;
constexpr double kBetweenPointsM = 0.03;  // between two points the lane may be so much nearer to walls

// Speeds: 0.35 m/s where a wall is touched, and 2.2 m/s more a metre of gap.
constexpr double kLeastGapMps = 0.35;
constexpr double kGapRate = 2.2;
constexpr double kBendSpanM = 0.4;       // to both sides, over which curvature is measured,
constexpr double kLeastBendSpanM = 0.3;  // none where the route is shorter
constexpr double kStraight = 1e-3;       // a smaller curvature, in rad/m, is none
constexpr double kTurnShare = 0.6;       // of the turn rate, in bends: the rest corrects
constexpr double kLeastBendMps = 0.15;

/// Unit vector to the right of the way at point i, by the direction over a few points around it.
Point2 right_of(const std::vector<Point2>& points, std::size_t i) {
  const std::size_t back = i >= kTangentSpan ? i - kTangentSpan : 0;
  const std::size_t front = std::min(points.size() - 1, i + kTangentSpan);
  const double yaw = geometry::bearing(points[back], points[front]);

  return {std::sin(yaw), -std::cos(yaw)};
}

/// How far a centre can move from `p` in this direction.
double reach_m(const grid::ClearanceField& clearance, Point2 p, Point2 direction, double needed_m) {
  double reach = 0.0;
  while (reach < kReachM && clearance.clearance_m(p + (reach + kReachStepM) * direction) >= needed_m)
    reach += kReachStepM;

  return reach;
}

/// Shift to the right, in metres, that leads from the plan to the lane at `p`.
double wanted_shift_m(const grid::ClearanceField& clearance, Point2 p, Point2 right, double radius_m,
                      const LaneSettings& settings) {
  // How much room there is to both sides, and where its middle is.
  const double needed = std::min(radius_m + settings.margin_m, clearance.clearance_m(p));
  const double to_right = reach_m(clearance, p, right, needed);
  const double to_left = reach_m(clearance, p, -1.0 * right, needed);
  const double room = to_left + to_right;
  const double middle = 0.5 * (to_right - to_left);
  const bool two_can_pass = room >= 2.0 * radius_m + settings.passing_gap_m;
  if (!two_can_pass) return std::clamp(middle, -kMostToMiddleM, kMostToMiddleM);

  // Half of the lanes' spacing right of the middle, or a quarter of the aisle, or as far as there is room.
  const double quarter = kQuarter * (room + 2.0 * (radius_m + settings.margin_m));
  const double half_spacing = std::min({0.5 * room, quarter, settings.half_spacing_m});

  return std::clamp(middle + half_spacing, -settings.shift_m, settings.shift_m);
}

/// Averages each shift with its neighbours, then bounds the slope from point to point, forwards and backwards, and
/// towards the ends, where the shift is 0.
std::vector<double> smooth_shifts(std::vector<double> shifts) {
  std::vector<double> averaged(shifts.size());
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t j = i >= kMeanSpan ? i - kMeanSpan : 0; j <= std::min(shifts.size() - 1, i + kMeanSpan);
         ++j, ++count)
      sum += shifts[j];

    averaged[i] = sum / count;
  }

  // The slope: no shift at both ends, and none that differs by more than `step` from its neighbours'.
  const double step = kSlope * kStepM;
  for (std::size_t i = 0; i < averaged.size(); ++i) {
    const double most = step * static_cast<double>(std::min(i, averaged.size() - 1 - i));
    averaged[i] = std::clamp(averaged[i], -most, most);
  }

  for (std::size_t i = 1; i < averaged.size(); ++i)
    averaged[i] = std::clamp(averaged[i], averaged[i - 1] - step, averaged[i - 1] + step);
  for (std::size_t i = averaged.size() - 1; i-- > 0;)
    averaged[i] = std::clamp(averaged[i], averaged[i + 1] - step, averaged[i + 1] + step);
  return averaged;
}

/// Pulls each point towards its neighbours and its own target; never closer to walls than `needed` or than it was.
void relax(std::vector<Point2>& points, const std::vector<Point2>& targets, const grid::ClearanceField& clearance,
           double needed_m) {
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Point2 bend = points[i - 1] + points[i + 1] - 2.0 * points[i];
      const Point2 moved = points[i] + kBendShare * bend + kTargetShare * (targets[i] - points[i]);
      const double now = clearance.clearance_m(points[i]);
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

}  // namespace

Route make_lane(const std::vector<Point2>& waypoints_in_map, const grid::ClearanceField& clearance, double radius_m,
                const LaneSettings& settings) {
  const std::vector<Point2> plan = resample(waypoints_in_map, kStepM);
  if (plan.size() < kLeastPoints) return Route(plan);

  // The shift at each point, smoothed.
  const double needed = radius_m + settings.margin_m;
  std::vector<double> shifts(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i)
    shifts[i] = wanted_shift_m(clearance, plan[i], right_of(plan, i), radius_m, settings);

  shifts = smooth_shifts(std::move(shifts));

  // The shifted points: where one is too near to walls, its shift shrinks.
  std::vector<Point2> points = plan;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Point2 right = right_of(plan, i);
    double shift = shifts[i];
    const double least = std::min(needed, clearance.clearance_m(plan[i]));
    while (std::abs(shift) > kLeastShiftM && clearance.clearance_m(plan[i] + shift * right) < least)
      shift *= kShiftShrinks;

    points[i] = plan[i] + (std::abs(shift) > kLeastShiftM ? shift : 0.0) * right;
  }

  // Relax, and keep the result only if it is safe.
  const std::vector<Point2> targets = points;
  relax(points, targets, clearance, needed);

  return Route(is_safe(points, plan, clearance, needed) ? points : plan);
}

std::vector<double> speed_profile(const Route& route, const grid::ClearanceField& clearance, double radius_m,
                                  const ProfileLimits& limits) {
  const auto& points = route.points();
  std::vector<double> speed(points.size(), limits.max_speed_mps);

  // Each point's own bound.
  for (std::size_t i = 0; limits.slows_on_the_way && i < points.size(); ++i) {
    const double gap = std::max(0.0, clearance.clearance_m(points[i]) - radius_m);
    speed[i] = std::min(speed[i], kLeastGapMps + kGapRate * gap);

    const double s = route.along_m(i);
    const double before = std::max(0.0, s - kBendSpanM);
    const double after = std::min(route.length_m(), s + kBendSpanM);
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
