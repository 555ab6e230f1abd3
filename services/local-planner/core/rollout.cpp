#include "services/local-planner/core/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

constexpr double kStandingMps = 0.05;
constexpr int kPathEvery = 4;             // steps; of a smooth trajectory that is enough

/// A pose with its heading as a unit vector: stepping it costs no call of libm.
struct Motion {
  Point2 position;
  Point2 heading;

  explicit Motion(const Pose2& pose) : position(pose.position()), heading{std::cos(pose.yaw), std::sin(pose.yaw)} {}
  Pose2 pose() const { return {position.x, position.y, std::atan2(heading.y, heading.x)}; }

  /// Along the arc's chord, which points half the turn to the side.
  void advance(double linear_mps, double angular_radps, double dt_s) {
    const double half = 0.5 * angular_radps * dt_s;
    const double h2 = half * half;
    const Point2 rotation = std::abs(half) < 0.15 ? Point2{1.0 - 0.5 * h2 + h2 * h2 / 24.0, half * (1.0 - h2 / 6.0 + h2 * h2 / 120.0)}
                                                  : Point2{std::cos(half), std::sin(half)};
    rotate(rotation);
    const double chord_m = linear_mps * dt_s * (1.0 - h2 / 6.0);
    position = position + chord_m * heading;
    rotate(rotation);
  }

 private:
  void rotate(Point2 by) { heading = {by.x * heading.x - by.y * heading.y, by.y * heading.x + by.x * heading.y}; }
};

double length(Point2 p) { return std::sqrt(geometry::dot(p, p)); }

/// To the nearest of the points, which lie close together.
double distance_to(const std::vector<Point2>& points, Point2 p) {
  double least2 = 1e18;
  for (const Point2 q : points) least2 = std::min(least2, geometry::dot(p - q, p - q));
  return std::sqrt(least2);
}

double wall_gap(const Scene& scene, Point2 p) { return scene.clearance.clearance_m(p) - scene.radius_m; }

double mover_gap(const Scene& scene, const Mover& mover, Point2 p, double t_s) {
  const Point2 there = mover.position_in_map + t_s * mover.velocity_in_map;
  return length(p - there) - scene.radius_m - mover.radius_m - mover.margin_m - mover.growth_mps * t_s;
}

double peer_gap(const Scene& scene, const PeerMotion& peer, Point2 p) {
  double least2 = 1e18;
  for (const Point2 q : peer.stopping_in_map) least2 = std::min(least2, geometry::dot(p - q, p - q));
  return std::sqrt(least2) - scene.radius_m - peer.radius_m;
}

/// Looks up distances to walls along a trajectory; where there was plenty a moment ago it does not look again:
/// the distance shrinks by at most what was driven.
class WallWatch {
 public:
  WallWatch(const Scene& scene, double enough_m) : scene_(scene), enough_m_(enough_m) {}
  /// The gap at `p`, or at least `enough_m`.
  double gap_m(Point2 p, double driven_m) {
    known_m_ -= driven_m;
    if (known_m_ < enough_m_) known_m_ = wall_gap(scene_, p);
    return known_m_;
  }

 private:
  const Scene& scene_;
  double enough_m_;
  double known_m_{-1e9};
};

}  // namespace

Needed needed_gaps(const Scene& scene, const DwaSettings& settings) {
  const Point2 here = scene.base_in_map.position();
  const double v = std::abs(scene.twist.linear_mps) + scene.limits.max_acceleration_mps2 * settings.window_s;
  const double stopping_m = v * settings.step_s + kinematics::stopping_distance_m(v, settings.braking_share * scene.limits.max_deceleration_mps2);
  const double stopping_s = settings.step_s + v / (settings.braking_share * scene.limits.max_deceleration_mps2);
  Needed needed;
  needed.wall = std::min(settings.wall_margin_m, wall_gap(scene, here));
  for (const PeerMotion& peer : scene.peers) {
    const double gap = peer_gap(scene, peer, here);
    if (gap < settings.peer_margin_m + stopping_m) needed.peers.emplace_back(&peer, std::min(settings.peer_margin_m, gap));
    if (!peer.intended_in_map.empty() && length(peer.intended_in_map.front() - here) < scene.radius_m + peer.radius_m + 1.0 + 2.0 * v * settings.horizon_s + 1.5 * settings.horizon_s)
      needed.met.push_back(&peer);
  }
  for (const Mover& mover : scene.movers) {
    const double speed = length(mover.velocity_in_map);
    const double gap = mover_gap(scene, mover, here, 0.0);
    // Somebody who walks right beside us: stand until they are past, whichever way they go.
    if (speed > 0.0 && gap + mover.margin_m < 0.08) needed.somebody_touches = true;
    if (gap < stopping_m + (speed + mover.growth_mps) * stopping_s) needed.movers.emplace_back(&mover, std::min(0.0, gap));
    if (gap < (speed + mover.growth_mps + v) * settings.horizon_s + 1.0) needed.foreseen.push_back(&mover);
  }
  return needed;
}

namespace {

Obstruction touched(const Scene& scene, const Needed& needed, Point2 p, double t_s, bool moving) {
  constexpr double kTiny = 1e-6;
  for (const auto& [peer, gap] : needed.peers)
    if (peer_gap(scene, *peer, p) < gap - kTiny) return Obstruction::kPeer;
  for (const auto& [mover, gap] : needed.movers)
    if ((moving || mover->velocity_in_map == Point2{}) && mover_gap(scene, *mover, p, t_s) < gap - kTiny) return Obstruction::kMover;
  return Obstruction::kNone;
}

}  // namespace

Obstruction obstruction(const Scene& scene, const Needed& needed, const Twist2& wanted, const DwaSettings& settings) {
  const double dt = settings.step_s;
  const Twist2 first = kinematics::limit_change(scene.twist, wanted, scene.limits, dt);
  if (std::abs(first.linear_mps) < 1e-3 && std::abs(scene.twist.linear_mps) < 1e-3) return Obstruction::kNone;
  if (needed.somebody_touches && std::abs(first.linear_mps) > 0.5 * kStandingMps) return Obstruction::kMover;
  const double braking = settings.braking_share * scene.limits.max_deceleration_mps2;
  double v = first.linear_mps;
  double w = first.angular_radps;
  Motion motion(scene.base_in_map);
  WallWatch walls(scene, needed.wall);
  double mean = 0.5 * (scene.twist.linear_mps + v);
  motion.advance(mean, 0.5 * (scene.twist.angular_radps + w), dt);
  for (double t = dt;; t += dt) {
    if (walls.gap_m(motion.position, std::abs(mean) * dt) < needed.wall - 1e-6) return Obstruction::kWall;
    const Obstruction found = touched(scene, needed, motion.position, t, std::abs(v) > kStandingMps);
    if (found != Obstruction::kNone) return found;
    if (std::abs(v) < 1e-3) return Obstruction::kNone;
    const double share = std::max(0.0, std::abs(v) - braking * dt) / std::abs(v);
    mean = 0.5 * (1.0 + share) * v;
    motion.advance(mean, 0.5 * (1.0 + share) * w, dt);
    v *= share;
    w *= share;
  }
}

Rollout roll_out(const Scene& scene, const Needed& needed, const Twist2& wanted, const Aim& aim, const DwaSettings& settings) {
  Rollout out;
  out.sample = {wanted, scene.base_in_map, scene.base_in_map, aim.wall_cap_m, aim.mover_cap_m, aim.mover_cap_m, aim.mover_cap_m};
  const double dt = settings.step_s;
  const int steps = static_cast<int>(std::lround(settings.horizon_s / dt));
  const int look = static_cast<int>(std::lround(settings.heading_s / dt));
  Twist2 twist = scene.twist;
  Motion motion(scene.base_in_map);
  double path_sum_m = 0.0;
  int path_looks = 0;
  WallWatch walls(scene, aim.wall_cap_m);
  const double allowed = std::min(0.0, wall_gap(scene, motion.position));
  for (int k = 1; k <= steps; ++k) {
    if (twist.linear_mps != wanted.linear_mps || twist.angular_radps != wanted.angular_radps)
      twist = kinematics::limit_change(twist, wanted, scene.limits, dt);
    motion.advance(twist.linear_mps, twist.angular_radps, dt);
    const double t = k * dt;
    const double gap = walls.gap_m(motion.position, std::abs(twist.linear_mps) * dt);
    out.sample.wall_gap_m = std::min(out.sample.wall_gap_m, gap);
    if (gap < allowed) {
      out.collides = Obstruction::kWall;
      return out;
    }
    for (const Mover* mover : needed.foreseen) {
      const Point2 there = mover->position_in_map + t * mover->velocity_in_map;
      const double distance = length(motion.position - there) - scene.radius_m - mover->radius_m;
      out.sample.mover_gap_m = std::min(out.sample.mover_gap_m, distance - mover->margin_m - mover->growth_mps * std::min(t, 1.0));
      double& gap_of_kind = mover->velocity_in_map == Point2{} ? out.sample.standing_gap_m : out.sample.moving_gap_m;
      gap_of_kind = std::min(gap_of_kind, distance);
      if (distance < 0.0) out.collides = Obstruction::kMover;
    }
    for (const PeerMotion* peer : needed.met) {
      const auto& intended = peer->intended_in_map;
      const Point2 there = intended[std::min<std::size_t>(static_cast<std::size_t>(k), intended.size() - 1)];
      const double distance = length(motion.position - there) - scene.radius_m - peer->radius_m;
      out.sample.mover_gap_m = std::min(out.sample.mover_gap_m, distance);
      out.sample.moving_gap_m = std::min(out.sample.moving_gap_m, distance);
      if (distance < 0.0) out.collides = Obstruction::kPeer;
    }
    if (k == look) out.sample.look_in_map = motion.pose();
    if (!aim.path_in_map.empty() && k % kPathEvery == 0) path_sum_m += distance_to(aim.path_in_map, motion.position), ++path_looks;
  }
  out.sample.end_in_map = motion.pose();
  if (path_looks > 0) out.sample.path_distance_m = path_sum_m / path_looks;
  return out;
}

Obstruction obstruction(const Scene& scene, const Twist2& wanted, const DwaSettings& settings) {
  return obstruction(scene, needed_gaps(scene, settings), wanted, settings);
}

}  // namespace aisle::local_planner
