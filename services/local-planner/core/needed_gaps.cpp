#include <algorithm>
#include <cmath>

#include "services/local-planner/core/lanes.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

/// The centres of the footprint's discs, now.
std::vector<Point2> centers_in_map(const Scene& scene) {
  const Point2 heading{std::cos(scene.base_in_map.yaw), std::sin(scene.base_in_map.yaw)};
  std::vector<Point2> centers;
  for (const double ahead_m : scene.discs_ahead_m)
    centers.push_back(ahead_m == 0.0 ? scene.base_in_map.position() : scene.base_in_map.position() + ahead_m * heading);
  return centers;
}

double least_distance(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  double least2 = 1e18;
  for (const Point2 p : a)
    for (const Point2 q : b) least2 = std::min(least2, geometry::dot(p - q, p - q));
  return std::sqrt(least2);
}

constexpr double kStartMps2 = 3.0;      // who stands is at a walk within half a second,
constexpr double kTurnMps2 = 1.5;       // who walks turns or stops more slowly,
constexpr double kMostChangeMps = 1.4;  // and changes the velocity by no more than this

}  // namespace

double Mover::reach_m(double t_s) const {
  if (!may_walk) return 0.0;
  const double change_mps2 = velocity_in_map == Point2{} ? kStartMps2 : kTurnMps2;
  const double changing_s = kMostChangeMps / change_mps2;
  const double since_s = unseen_s + t_s;
  return since_s < changing_s ? 0.5 * change_mps2 * since_s * since_s : kMostChangeMps * (since_s - 0.5 * changing_s);
}

namespace {

/// Within the window, in m/s.
double fastest_base_mps(const Scene& scene, double window_s) {
  return speed_of(scene.twist) + scene.limits.max_acceleration_mps2 * window_s;
}

/// The same of any point of the vehicle: a turn on the spot moves all of it but a disc.
double fastest_point_mps(const Scene& scene, double window_s) {
  const kinematics::Limits& limits = scene.limits;
  const bool can_turn_at_once = limits.model == kinematics::Model::kTricycle;  // by its steering
  const double turn_radps = std::abs(scene.twist.angular_radps) + limits.max_turn_acceleration_radps2 * window_s;
  const double most_radps = std::max(limits.max_turn_radps, std::abs(scene.twist.angular_radps));
  return fastest_base_mps(scene, window_s) +
         swing_m(scene) * (can_turn_at_once ? most_radps : std::min(turn_radps, most_radps));
}

}  // namespace

DiscGaps wall_gaps_m(const Scene& scene) {
  DiscGaps gaps_m;
  gaps_m.fill(1e18);
  const std::vector<Point2> centers = centers_in_map(scene);
  for (std::size_t i = 0; i < centers.size(); ++i) gaps_m[i] = scene.clearance.clearance_m(centers[i]) - scene.radius_m;
  return gaps_m;
}

Needed needed_gaps(const Scene& scene, const DwaSettings& settings) {
  const std::vector<Point2> here = centers_in_map(scene);
  const double v = fastest_point_mps(scene, settings.window_s);
  const double foreseen_m =
      fastest_base_mps(scene, settings.window_s) * settings.horizon_s + 2.0 * swing_m(scene) + 1.0;
  const double stopping_m = v * settings.step_s + kinematics::stopping_distance_m(
                                                      v, settings.braking_share * scene.limits.max_deceleration_mps2);
  const double stopping_s = settings.step_s + v / (settings.braking_share * scene.limits.max_deceleration_mps2);
  Needed needed;
  needed.wall_gaps_m = wall_gaps_m(scene);
  needed.wall =
      std::min(settings.wall_margin_m, *std::min_element(needed.wall_gaps_m.begin(), needed.wall_gaps_m.end()));
  for (const PeerMotion& peer : scene.peers) {
    const double gap = least_distance(here, peer.stopping_in_map) - scene.radius_m - peer.radius_m;
    if (gap < settings.peer_margin_m + stopping_m)
      needed.peers.emplace_back(&peer, std::min(settings.peer_margin_m, gap));
    if (least_distance(here, peer.intended_in_map) < scene.radius_m + peer.radius_m + foreseen_m)
      needed.met.push_back(&peer);
  }
  for (const Mover& mover : scene.movers) {
    const double speed = std::sqrt(geometry::dot(mover.velocity_in_map, mover.velocity_in_map));
    const double gap = least_distance(here, {mover.position_in_map}) - scene.radius_m - mover.radius_m - mover.margin_m;
    // Somebody who walks right beside us: stand until they are past, whichever way they go.
    if (speed > 0.0 && gap + mover.margin_m < 0.08) needed.somebody_touches = true;
    if (gap < stopping_m + (speed + mover.growth_mps) * stopping_s + mover.reach_m(stopping_s))
      needed.movers.emplace_back(&mover, std::min(0.0, gap));
    if (gap < (speed + mover.growth_mps) * settings.horizon_s + foreseen_m) needed.foreseen.push_back(&mover);
  }
  return needed;
}

}  // namespace aisle::local_planner
