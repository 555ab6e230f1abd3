#include "services/local-planner/core/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

constexpr double kReactionS = 0.15;        // a peer may speed up for so long before it sees what we see
constexpr double kWalkedM = 0.75;          // farther than another view of a standing thing moves its middle
constexpr double kLongestCarriedS = 1.0;   // a track's motion is not carried on for longer
constexpr double kMostSigmaM = 0.15;       // of a track's place; more uncertainty does not widen the margin
constexpr double kMostSigmaMps = 0.3;      // of its velocity, likewise
constexpr double kThingGrowthShare = 0.5;  // of a person's: what stands, and may be a person
constexpr double kSweepStepS = 0.1;        // of a peer's braking
constexpr double kPeerStandsMps = 0.02;    // a slower peer sweeps nothing
constexpr double kPeerStoppedMps = 1e-3;   // its braking ends here
constexpr double kPeersWithinM = 6.0;      // a peer farther away is not met before it is seen again, many times
constexpr double kRoundingS = 1e-9;

/// Rows of a track's covariance, 4 x 4 and row by row: x, y, vx, vy.
constexpr int kVarianceX = 0;
constexpr int kVarianceY = 5;
constexpr int kVarianceVx = 10;
constexpr int kVarianceVy = 15;

/// The root of the larger of two variances.
double larger_sigma(double variance, double other) { return std::sqrt(std::max(0.0, std::max(variance, other))); }

/// A track as a disc that moves on at constant velocity from when the next command acts. What stands has a small
/// margin; what moves a wider one, by the standard deviations of its place and velocity.
Mover mover_of(const SeenTrack& seen, const SurroundingsSettings& settings, time::Stamp now) {
  const auto& track = seen.track;
  const double speed_mps = geometry::norm(track.velocity_in_map);
  const bool stands = track.is_static || speed_mps < settings.standing_mps;
  const double age_s = time::seconds(now - seen.arrived) + settings.track_latency_s + settings.dead_time_s;

  Mover mover;
  mover.velocity_in_map = stands ? Point2{} : track.velocity_in_map;
  mover.position_in_map = track.position_in_map + std::min(age_s, kLongestCarriedS) * mover.velocity_in_map;
  mover.radius_m = track.radius_m;
  mover.may_walk = !track.is_static;
  mover.unseen_s = std::min(age_s, kLongestCarriedS);

  if (stands) {
    mover.margin_m = settings.standing_margin_m;
    mover.growth_mps = track.is_static ? 0.0 : kThingGrowthShare * settings.mover_growth_mps;
    return mover;
  }

  // What moves: a margin for how uncertain the place is, which grows with how uncertain the velocity is.
  const double sigma_m = larger_sigma(track.covariance[kVarianceX], track.covariance[kVarianceY]);
  const double sigma_mps = larger_sigma(track.covariance[kVarianceVx], track.covariance[kVarianceVy]);
  mover.margin_m = settings.mover_margin_m + std::min(kMostSigmaM, sigma_m);
  mover.growth_mps = settings.mover_growth_mps + std::min(kMostSigmaMps, sigma_mps);

  return mover;
}

/// Where the peer can come while it brakes, after it went on for the time that it needs to react: poses in map, every
/// 0.1 s. Within a step of braking it is driven on with the mean of the speeds at the step's ends, along its arc.
std::vector<Pose2> stopping_sweep(const PeerView& peer, const Peer& sample, double ahead_s) {
  std::vector<Pose2> sweep{peer.base_in_map};
  Twist2 twist = sample.state.twist;
  if (std::abs(twist.linear_mps) < kPeerStandsMps) return sweep;

  Pose2 pose = peer.base_in_map;
  const double dt = kSweepStepS;
  const double reaction_s = kReactionS + ahead_s;

  // Before it reacts it goes on as it does.
  for (double t = 0.0; t < reaction_s - kRoundingS; t += dt) {
    pose = kinematics::advance(pose, twist, std::min(dt, reaction_s - t));
    sweep.push_back(pose);
  }

  // Then it brakes: v' = max(0, v - a dt), driven as the mean (v + v') / 2 along the same arc.
  while (std::abs(twist.linear_mps) > kPeerStoppedMps) {
    const double next = std::max(0.0, std::abs(twist.linear_mps) - sample.limits.max_deceleration_mps2 * dt);
    const double share = next / std::abs(twist.linear_mps);

    pose = kinematics::advance(
        pose, {0.5 * (1 + share) * twist.linear_mps, 0.5 * (1 + share) * twist.angular_radps, 0.0}, dt);
    twist = {share * twist.linear_mps, share * twist.angular_radps, 0.0};
    sweep.push_back(pose);
  }

  return sweep;
}

/// A point of the vehicle's axis, in map.
Point2 ahead_of(const Pose2& base_in_map, double ahead_m) {
  return ahead_m == 0.0 ? base_in_map.position() : geometry::to_map(base_in_map, {ahead_m, 0.0});
}

}  // namespace

bool Observer::has_walked(const SeenTrack& seen) {
  const auto [first, is_new] = first_seen_in_map_.try_emplace(seen.track.id, seen.track.position_in_map);
  return !is_new && geometry::distance(first->second, seen.track.position_in_map) > kWalkedM;
}

void Observer::forget_all_but(const std::vector<SeenTrack>& tracks) {
  for (auto it = first_seen_in_map_.begin(); it != first_seen_in_map_.end();) {
    const bool is_there =
        std::any_of(tracks.begin(), tracks.end(), [&](const SeenTrack& seen) { return seen.track.id == it->first; });
    it = is_there ? std::next(it) : first_seen_in_map_.erase(it);
  }
}

Surroundings Observer::observe(const Inputs& inputs, Point2 here_in_map, time::Stamp now) {
  Surroundings out;
  for (const SeenTrack& seen : inputs.tracks) {
    Mover mover = mover_of(seen, settings_, now);
    mover.has_walked = has_walked(seen);
    out.movers.push_back(mover);
    if (mover.velocity_in_map == Point2{}) out.add_standing({mover.position_in_map, mover.radius_m}, {});
  }

  forget_all_but(inputs.tracks);

  for (const Peer& peer : inputs.peers)
    if (geometry::distance(peer.state.base_in_map.position(), here_in_map) < kPeersWithinM) add_peer(out, peer, now);

  return out;
}

void Observer::add_peer(Surroundings& out, const Peer& peer, time::Stamp now) {
  const PeerView seen = peers_.view(peer, now);
  const std::vector<Pose2> stopping_in_map = stopping_sweep(seen, peer, settings_.dead_time_s);

  // A peer that has stood for long is driven around like a thing.
  const bool stays = seen.standing_s > settings_.peer_patience_s;

  const geometry::CoveringDiscs discs =
      geometry::covering_discs(peer.rectangle ? *peer.rectangle : geometry::disc(peer.radius_m));
  for (const double ahead_m : discs.ahead_m) {
    PeerMotion motion;
    motion.radius_m = discs.radius_m;
    for (const Pose2& pose : stopping_in_map) motion.stopping_in_map.push_back(ahead_of(pose, ahead_m));
    if (stays) out.add_standing({ahead_of(seen.base_in_map, ahead_m), discs.radius_m}, peer.id);
    out.peer_motions.push_back(std::move(motion));
  }
}

void Surroundings::add_standing(const Disc& disc, const std::string& vehicle_id) {
  standing.push_back({disc, vehicle_id});
  standing_discs.push_back(disc);
}

}  // namespace aisle::local_planner
