#include "services/local-planner/core/tube.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/local-planner/core/motion.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

constexpr double kSpareShare = 0.3;  // of the tube's half width: left for what a vehicle does not do as it is told
constexpr double kRoundingM = 1e-6;
constexpr double kSwingM = 0.03;
constexpr double kMostSwingM = 0.3;
constexpr double kBehindM = 0.5;  // of the vehicle a tube is looked at,
constexpr double kAheadM = 1.5;   // and so far ahead: farther than it needs to brake
constexpr double kFlatM = 1e-4;   // a point so near to the line between its neighbours says nothing

/// The path's point nearest to a place: on segment i of the path, a share t of it along.
struct Foot {
  Point2 in_map;
  std::size_t i{0};
  double t{0.0};
  double distance2{std::numeric_limits<double>::infinity()};
};

/// On each segment the foot is t = (p - a) . (b - a) / |b - a|^2 within [0, 1].
Foot foot_of(const std::vector<Point2>& path, Point2 p) {
  Foot nearest;
  if (path.size() == 1) return {path.front(), 0, 0.0, geometry::dot(p - path.front(), p - path.front())};

  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point2 ab = path[i + 1] - path[i];
    const double length2 = geometry::dot(ab, ab);
    const double t = length2 > 0.0 ? std::clamp(geometry::dot(p - path[i], ab) / length2, 0.0, 1.0) : 0.0;
    const Point2 foot = path[i] + t * ab;
    const double distance2 = geometry::dot(p - foot, p - foot);
    if (distance2 < nearest.distance2) nearest = {foot, i, t, distance2};
  }

  return nearest;
}

/// The path's heading at the foot, in rad: at a point the mean of both segments', and evenly from point to point, for
/// an arc is given by few points.
double heading_at(const std::vector<Point2>& path, const Foot& foot) {
  const auto of_segment = [&](std::size_t i) { return geometry::bearing(path[i], path[i + 1]); };
  const double here = of_segment(foot.i);
  const double turned_before = foot.i > 0 ? geometry::wrap(here - of_segment(foot.i - 1)) : 0.0;
  const double turns_after = foot.i + 2 < path.size() ? geometry::wrap(of_segment(foot.i + 1) - here) : 0.0;

  return here - 0.5 * (1.0 - foot.t) * turned_before + 0.5 * foot.t * turns_after;
}

/// The path without points that lie on the line from the last point that is kept to the next one: a lane has one every
/// few centimetres, and every one costs each twist that is looked at.
std::vector<Point2> without_flat_points(const std::vector<Point2>& path) {
  std::vector<Point2> kept{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Foot foot = foot_of({kept.back(), path[i + 1]}, path[i]);
    if (foot.distance2 > kFlatM * kFlatM) kept.push_back(path[i]);
  }

  if (path.size() > 1) kept.push_back(path.back());
  return kept;
}

}  // namespace

Tube tube_along(const Route& lane, double s_m, double end_m, double half_width_m) {
  const double from_m = std::max(0.0, s_m - kBehindM);
  return {lane.part(from_m, std::max(from_m, std::min({s_m + kAheadM, end_m, lane.length_m()}))), half_width_m};
}

double off_path_m(const std::vector<Point2>& path_in_map, const Pose2& base_in_map,
                  const std::vector<double>& discs_ahead_m, bool turns_on_the_spot) {
  const Foot foot = foot_of(path_in_map, base_in_map.position());
  double most_m = std::sqrt(foot.distance2);
  if (turns_on_the_spot || path_in_map.size() < 2) return most_m;

  const Pose2 on_path{foot.in_map.x, foot.in_map.y, heading_at(path_in_map, foot)};
  for (const double ahead_m : discs_ahead_m)
    most_m = std::max(most_m, geometry::distance(geometry::to_map(base_in_map, {ahead_m, 0.0}),
                                                 geometry::to_map(on_path, {ahead_m, 0.0})));

  return most_m;
}

TubeKeeping::TubeKeeping(const Scene& scene, const Tube& tube, const DwaSettings& settings)
    : scene_(scene),
      step_s_(settings.step_s),
      braking_mps2_(settings.braking_share * scene.limits.max_deceleration_mps2),
      turns_on_the_spot_(scene.limits.model != kinematics::Model::kTricycle),
      path_in_map_(turns_on_the_spot_ ? without_flat_points(tube.path_in_map) : tube.path_in_map),
      half_width_m_(tube.half_width_m),
      most_off_m_(most_off_m(off_m(scene.base_in_map))) {}

// A vehicle that cannot turn on the spot swings its corners out before it comes in: it needs all the tube, and a bit.
double TubeKeeping::most_off_m(double now_m) const {
  if (turns_on_the_spot_) return std::max((1.0 - kSpareShare) * half_width_m_, now_m + kRoundingM);

  return std::max({half_width_m_, std::min(now_m + kSwingM, half_width_m_ + kMostSwingM), now_m + kRoundingM});
}

double TubeKeeping::off_m(const Pose2& base_in_map) const {
  return off_path_m(path_in_map_, base_in_map, scene_.discs_ahead_m, turns_on_the_spot_);
}

bool TubeKeeping::to(const Twist2& wanted) const {
  // The step in which the command is taken up, driven with the mean of before and after.
  const Twist2& now = scene_.twist;
  const Twist2 then = kinematics::follow({now, scene_.steering_rad}, wanted, scene_.limits, step_s_).twist;
  const Twist2 mean{0.5 * (now.linear_mps + then.linear_mps), 0.5 * (now.angular_radps + then.angular_radps),
                    0.5 * (now.sideways_mps + then.sideways_mps)};
  const Pose2 taken_up = kinematics::advance(scene_.base_in_map, mean, step_s_);
  if (off_m(taken_up) > most_off_m_) return false;

  // Then it brakes: v / a seconds, driven as if with half the speed.
  const double braking_s = speed_of(then) / braking_mps2_;
  const Twist2 half{0.5 * then.linear_mps, 0.5 * then.angular_radps, 0.5 * then.sideways_mps};

  return off_m(kinematics::advance(taken_up, half, braking_s)) <= most_off_m_ &&
         off_m(kinematics::advance(taken_up, half, 0.5 * braking_s)) <= most_off_m_;
}

}  // namespace aisle::local_planner
