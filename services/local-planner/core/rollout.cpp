#include "services/local-planner/core/rollout.hpp"

#include <algorithm>
#include <array>
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
  void advance(const Twist2& twist, double dt_s) {
    const double half = 0.5 * twist.angular_radps * dt_s;
    const double h2 = half * half;
    const Point2 rotation = std::abs(half) < 0.15 ? Point2{1.0 - 0.5 * h2 + h2 * h2 / 24.0, half * (1.0 - h2 / 6.0 + h2 * h2 / 120.0)}
                                                  : Point2{std::cos(half), std::sin(half)};
    rotate(rotation);
    const double chord_m = twist.linear_mps * dt_s * (1.0 - h2 / 6.0);
    position = position + chord_m * heading;
    if (twist.sideways_mps != 0.0) position = position + (twist.sideways_mps * dt_s * (1.0 - h2 / 6.0)) * Point2{-heading.y, heading.x};
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

/// The centres of the footprint's discs; a vehicle that is a disc has one, in its base.
struct Outline {
  std::array<Point2, kMostDiscs> centers;
  std::size_t count{1};

  Outline(const Scene& scene, const Motion& motion) : centers{motion.position} {
    if (is_disc(scene)) return;
    count = 0;
    for (const double ahead_m : scene.discs_ahead_m) centers[count++] = motion.position + ahead_m * motion.heading;
  }
  static bool is_disc(const Scene& scene) { return scene.discs_ahead_m.size() == 1 && scene.discs_ahead_m.front() == 0.0; }

  double distance_to(Point2 p) const {
    double least2 = geometry::dot(centers[0] - p, centers[0] - p);
    for (std::size_t i = 1; i < count; ++i) least2 = std::min(least2, geometry::dot(centers[i] - p, centers[i] - p));
    return std::sqrt(least2);
  }
};

/// Farthest centre of a disc from the base: what a turn swings.
double swing_m(const Scene& scene) {
  double most = 0.0;
  for (const double ahead_m : scene.discs_ahead_m) most = std::max(most, std::abs(ahead_m));
  return most;
}

double speed_of(const Twist2& twist) {
  return twist.sideways_mps == 0.0 ? std::abs(twist.linear_mps) : std::hypot(twist.linear_mps, twist.sideways_mps);
}

double wall_gap(const Scene& scene, const Outline& outline) {
  double least = scene.clearance.clearance_m(outline.centers[0]);
  for (std::size_t i = 1; i < outline.count; ++i) least = std::min(least, scene.clearance.clearance_m(outline.centers[i]));
  return least - scene.radius_m;
}

double mover_gap(const Scene& scene, const Mover& mover, const Outline& outline, double t_s) {
  const Point2 there = mover.position_in_map + t_s * mover.velocity_in_map;
  return outline.distance_to(there) - scene.radius_m - mover.radius_m - mover.margin_m - mover.growth_mps * t_s;
}

double peer_gap(const Scene& scene, const PeerMotion& peer, const Outline& outline) {
  double least2 = 1e18;
  for (std::size_t i = 0; i < outline.count; ++i)
    for (const Point2 q : peer.stopping_in_map) least2 = std::min(least2, geometry::dot(outline.centers[i] - q, outline.centers[i] - q));
  return std::sqrt(least2) - scene.radius_m - peer.radius_m;
}

/// Looks up distances to walls along a trajectory; where there was plenty a moment ago it does not look again:
/// the distance shrinks by at most what was driven.
class WallWatch {
 public:
  WallWatch(const Scene& scene, double enough_m) : scene_(scene), enough_m_(enough_m) {}
  /// The gap there, or at least `enough_m`.
  double gap_m(const Outline& outline, double driven_m) {
    known_m_ -= driven_m;
    if (known_m_ < enough_m_) known_m_ = wall_gap(scene_, outline);
    return known_m_;
  }

 private:
  const Scene& scene_;
  double enough_m_;
  double known_m_{-1e9};
};

}  // namespace

double fastest_point_mps(const Scene& scene, const Twist2& twist) { return std::max(speed_of(twist), swing_m(scene) * std::abs(twist.angular_radps)); }

Needed needed_gaps(const Scene& scene, const DwaSettings& settings) {
  const Outline here(scene, Motion(scene.base_in_map));
  const double v = fastest_point_mps(scene, scene.twist) + scene.limits.max_acceleration_mps2 * settings.window_s;
  const double stopping_m = v * settings.step_s + kinematics::stopping_distance_m(v, settings.braking_share * scene.limits.max_deceleration_mps2);
  const double stopping_s = settings.step_s + v / (settings.braking_share * scene.limits.max_deceleration_mps2);
  Needed needed;
  needed.wall = std::min(settings.wall_margin_m, wall_gap(scene, here));
  for (const PeerMotion& peer : scene.peers) {
    const double gap = peer_gap(scene, peer, here);
    if (gap < settings.peer_margin_m + stopping_m) needed.peers.emplace_back(&peer, std::min(settings.peer_margin_m, gap));
    if (!peer.intended_in_map.empty() && here.distance_to(peer.intended_in_map.front()) < scene.radius_m + peer.radius_m + 1.0 + 2.0 * v * settings.horizon_s + 1.5 * settings.horizon_s)
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

Obstruction touched(const Scene& scene, const Needed& needed, const Outline& p, double t_s, bool moving) {
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
  const double swing = swing_m(scene);
  const auto fastest = [swing](const Twist2& twist) { return std::max(speed_of(twist), swing * std::abs(twist.angular_radps)); };
  Twist2 twist = kinematics::follow({scene.twist, scene.steering_rad}, wanted, scene.limits, dt).twist;
  double speed = fastest(twist);
  if (speed < 1e-3 && fastest(scene.twist) < 1e-3) return Obstruction::kNone;
  if (needed.somebody_touches && speed > 0.5 * kStandingMps) return Obstruction::kMover;
  const double braking = settings.braking_share * scene.limits.max_deceleration_mps2;
  Motion motion(scene.base_in_map);
  WallWatch walls(scene, needed.wall);
  Twist2 mean{0.5 * (scene.twist.linear_mps + twist.linear_mps), 0.5 * (scene.twist.angular_radps + twist.angular_radps),
              0.5 * (scene.twist.sideways_mps + twist.sideways_mps)};
  motion.advance(mean, dt);
  for (double t = dt;; t += dt) {
    const Outline outline(scene, motion);
    if (walls.gap_m(outline, speed_of(mean) * dt + swing * std::abs(mean.angular_radps) * dt) < needed.wall - 1e-6) return Obstruction::kWall;
    const Obstruction found = touched(scene, needed, outline, t, speed > kStandingMps);
    if (found != Obstruction::kNone) return found;
    if (speed < 1e-3) return Obstruction::kNone;
    const double share = std::max(0.0, speed - braking * dt) / speed;
    const double half = 0.5 * (1.0 + share);
    mean = {half * twist.linear_mps, half * twist.angular_radps, half * twist.sideways_mps};
    motion.advance(mean, dt);
    twist = {share * twist.linear_mps, share * twist.angular_radps, share * twist.sideways_mps};
    speed = fastest(twist);
  }
}

Rollout roll_out(const Scene& scene, const Needed& needed, const Twist2& wanted, const Aim& aim, const DwaSettings& settings) {
  Rollout out;
  out.sample = {wanted, scene.base_in_map, scene.base_in_map, aim.wall_cap_m, aim.mover_cap_m, aim.mover_cap_m, aim.mover_cap_m};
  const double dt = settings.step_s;
  const int steps = static_cast<int>(std::lround(settings.horizon_s / dt));
  const int look = static_cast<int>(std::lround(settings.heading_s / dt));
  const double swing = swing_m(scene);
  kinematics::DriveState drive{scene.twist, scene.steering_rad};
  const Twist2& twist = drive.twist;
  Motion motion(scene.base_in_map);
  double path_sum_m = 0.0;
  int path_looks = 0;
  WallWatch walls(scene, aim.wall_cap_m);
  const double allowed = std::min(0.0, wall_gap(scene, Outline(scene, motion)));
  for (int k = 1; k <= steps; ++k) {
    if (twist.linear_mps != wanted.linear_mps || twist.angular_radps != wanted.angular_radps || twist.sideways_mps != wanted.sideways_mps)
      drive = kinematics::follow(drive, wanted, scene.limits, dt);
    motion.advance(twist, dt);
    const Outline outline(scene, motion);
    const double t = k * dt;
    const double gap = walls.gap_m(outline, speed_of(twist) * dt + swing * std::abs(twist.angular_radps) * dt);
    out.sample.wall_gap_m = std::min(out.sample.wall_gap_m, gap);
    if (gap < allowed) {
      out.collides = Obstruction::kWall;
      return out;
    }
    for (const Mover* mover : needed.foreseen) {
      const Point2 there = mover->position_in_map + t * mover->velocity_in_map;
      const double distance = outline.distance_to(there) - scene.radius_m - mover->radius_m;
      out.sample.mover_gap_m = std::min(out.sample.mover_gap_m, distance - mover->margin_m - mover->growth_mps * std::min(t, 1.0));
      double& gap_of_kind = mover->velocity_in_map == Point2{} ? out.sample.standing_gap_m : out.sample.moving_gap_m;
      gap_of_kind = std::min(gap_of_kind, distance);
      if (distance < 0.0) out.collides = Obstruction::kMover;
    }
    for (const PeerMotion* peer : needed.met) {
      const auto& intended = peer->intended_in_map;
      const Point2 there = intended[std::min<std::size_t>(static_cast<std::size_t>(k), intended.size() - 1)];
      const double distance = outline.distance_to(there) - scene.radius_m - peer->radius_m;
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
