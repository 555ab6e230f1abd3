#include <algorithm>
#include <cmath>
#include <limits>

#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/walls.hpp"

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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Between the nearest two of them.
double least_distance_m(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  double least2 = kInfinity;
  for (const Point2 p : a)
    for (const Point2 q : b) least2 = std::min(least2, geometry::dot(p - q, p - q));

  return std::sqrt(least2);
}

// How a person may change the velocity.
constexpr double kStartMps2 = 3.0;      // from a stand to a walk within half a second
constexpr double kTurnMps2 = 1.5;       // turning or stopping takes longer
constexpr double kMostChangeMps = 1.4;  // in all
constexpr double kBesideM = 0.08;       // a walking person nearer than this is beside the vehicle

constexpr double kForeseenReserveM = 1.0;  // beyond what the fastest sample can reach: clearance that critics ask for

/// Does a walking person's body come within kBesideM of the vehicle, where they were seen or where they are expected by
/// the scene's moment? A person who walks away fast may have been taken for faster than they are.
bool is_beside(const std::vector<Point2>& here, double radius_m, const Mover& mover) {
  if (!mover.may_walk || mover.velocity_in_map == Point2{}) return false;

  const Point2 seen_in_map = mover.position_in_map - mover.unseen_s * mover.velocity_in_map;
  const double distance_m = least_distance_m(here, {seen_in_map, mover.position_in_map});
  return distance_m - radius_m - mover.radius_m < kBesideM;
}

/// Of the base, within the window.
double fastest_base_in_window_mps(const Scene& scene, double window_s) {
  return speed_of(scene.twist) + scene.limits.max_acceleration_mps2 * window_s;
}

/// Of any point of the vehicle, within the window: a turn on the spot moves all of it but a disc.
double fastest_point_in_window_mps(const Scene& scene, double window_s) {
  const kinematics::Limits& limits = scene.limits;
  const bool can_turn_at_once = limits.model == kinematics::Model::kTricycle;  // by its steering
  const double turn_radps = std::abs(scene.twist.angular_radps) + limits.max_turn_acceleration_radps2 * window_s;
  const double most_radps = std::max(limits.max_turn_radps, std::abs(scene.twist.angular_radps));

  return fastest_base_in_window_mps(scene, window_s) +
         swing_m(scene) * (can_turn_at_once ? most_radps : std::min(turn_radps, most_radps));
}

}  // namespace

// From then on the velocity changes by a t, up to a greatest change: half a t^2, then that change times the time.
double Mover::reach_m(double t_s) const {
  if (!may_walk) return 0.0;
  const double change_mps2 = velocity_in_map == Point2{} ? kStartMps2 : kTurnMps2;
  const double changing_s = kMostChangeMps / change_mps2;

  const double since_s = unseen_s + t_s;

  return since_s < changing_s ? 0.5 * change_mps2 * since_s * since_s : kMostChangeMps * (since_s - 0.5 * changing_s);
}

int DwaSettings::steps() const { return static_cast<int>(std::lround(horizon_s / step_s)); }

int DwaSettings::look_step() const { return static_cast<int>(std::lround(heading_s / step_s)); }

int DwaSettings::last_wall_step(const Aim& aim) const {
  constexpr double kRounding = 1e-9;  // a whole number of steps is not one step more
  return static_cast<int>(std::ceil(std::min(aim.walls_s, horizon_s) / step_s - kRounding));
}

double fastest_point_mps(const geometry::Twist2& twist, double swing_m) {
  return std::max(speed_of(twist), swing_m * std::abs(twist.angular_radps));
}

double standing_since_s(double was_mps, double speed_mps, double dt_s) {
  return was_mps > speed_mps ? dt_s * (kStandingMps - speed_mps) / (was_mps - speed_mps) : 0.0;
}

DiscGaps wall_gaps_m(const Scene& scene) {
  DiscGaps gaps_m;
  gaps_m.fill(kInfinity);

  const std::vector<Point2> centers = centers_in_map(scene);
  for (std::size_t i = 0; i < centers.size(); ++i) gaps_m[i] = scene.clearance.clearance_m(centers[i]) - scene.radius_m;

  return gaps_m;
}

Needed needed_gaps(const Scene& scene, const DwaSettings& settings) {
  // What the vehicle can come near to, at most: while braking, and within the horizon.
  const std::vector<Point2> here = centers_in_map(scene);
  const double braking_mps2 = settings.braking_share * scene.limits.max_deceleration_mps2;
  const double fastest_mps = fastest_point_in_window_mps(scene, settings.window_s);

  const double stopping_m = fastest_mps * settings.step_s + kinematics::stopping_distance_m(fastest_mps, braking_mps2);
  const double stopping_s = settings.step_s + fastest_mps / braking_mps2;

  const double foreseen_m = fastest_base_in_window_mps(scene, settings.window_s) * settings.horizon_s +
                            2.0 * swing_m(scene) + kForeseenReserveM;

  Needed needed;
  needed.wall_gaps_m = wall_gaps_m(scene);
  needed.wall =
      std::min(settings.wall_margin_m, *std::min_element(needed.wall_gaps_m.begin(), needed.wall_gaps_m.end()));

  for (const PeerMotion& peer : scene.peers) {
    const double gap_m = least_distance_m(here, peer.stopping_in_map) - scene.radius_m - peer.radius_m;
    if (gap_m < settings.peer_margin_m + stopping_m)
      needed.peers.emplace_back(&peer, std::min(settings.peer_margin_m, gap_m));
  }

  for (const Mover& mover : scene.movers) {
    const double mps = std::sqrt(geometry::dot(mover.velocity_in_map, mover.velocity_in_map));
    const double gap_m =
        least_distance_m(here, {mover.position_in_map}) - scene.radius_m - mover.radius_m - mover.margin_m;

    // Beside a walking person the vehicle stands until they are past, whichever way they go.
    if (is_beside(here, scene.radius_m, mover)) needed.is_person_beside = true;
    if (gap_m < stopping_m + (mps + mover.growth_mps) * stopping_s + mover.reach_m(stopping_s))
      needed.movers.emplace_back(&mover, std::min(0.0, gap_m));

    // In a tube what stands is stopped before, not steered around.
    const bool is_foreseen = scene.tube == nullptr || mps > 0.0;
    if (is_foreseen && gap_m < (mps + mover.growth_mps) * settings.horizon_s + foreseen_m)
      needed.foreseen.push_back(&mover);
  }

  return needed;
}

}  // namespace aisle::local_planner
