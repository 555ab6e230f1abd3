#include "services/local-planner/core/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

constexpr double kReactionS = 0.15;  // a peer may speed up for so long before it sees what we see
constexpr double kHonouredIntentS = 2.0;
constexpr double kWalkedM = 0.75;  // what has come so far is no thing: another view of a thing moves its middle by less

Mover mover_of(const SeenTrack& seen, const SurroundingsSettings& settings, time::Stamp now) {
  const auto& track = seen.track;
  const double speed = geometry::norm(track.velocity_in_map);
  const bool stands = track.is_static || speed < settings.standing_mps;
  const double age = time::seconds(now - seen.arrived) + settings.track_latency_s + settings.dead_time_s;
  Mover mover;
  mover.velocity_in_map = stands ? Point2{} : track.velocity_in_map;
  mover.position_in_map = track.position_in_map + std::min(age, 1.0) * mover.velocity_in_map;
  mover.radius_m = track.radius_m;
  mover.may_walk = !track.is_static;
  mover.unseen_s = std::min(age, 1.0);
  if (stands) {
    mover.margin_m = settings.standing_margin_m;
    mover.growth_mps = track.is_static ? 0.0 : 0.5 * settings.mover_growth_mps;
    return mover;
  }
  const double sigma_m = std::sqrt(std::max(0.0, std::max(track.covariance[0], track.covariance[5])));
  const double sigma_mps = std::sqrt(std::max(0.0, std::max(track.covariance[10], track.covariance[15])));
  mover.margin_m = settings.mover_margin_m + std::min(0.15, sigma_m);
  mover.growth_mps = settings.mover_growth_mps + std::min(0.3, sigma_mps);
  return mover;
}

/// Where the peer can come while it brakes, after it went on for the time that it needs to react.
std::vector<Pose2> stopping_sweep(const PeerView& peer, const Peer& sample, double ahead_s) {
  std::vector<Pose2> sweep{peer.base_in_map};
  Twist2 twist = sample.state.twist;
  if (std::abs(twist.linear_mps) < 0.02) return sweep;
  Pose2 pose = peer.base_in_map;
  const double dt = 0.1;
  const double reaction_s = kReactionS + ahead_s;
  for (double t = 0.0; t < reaction_s - 1e-9; t += dt) {
    pose = kinematics::advance(pose, twist, std::min(dt, reaction_s - t));
    sweep.push_back(pose);
  }
  while (std::abs(twist.linear_mps) > 1e-3) {
    const double next = std::max(0.0, std::abs(twist.linear_mps) - sample.limits.max_deceleration_mps2 * dt);
    const double share = next / std::abs(twist.linear_mps);
    pose = kinematics::advance(
        pose, {0.5 * (1 + share) * twist.linear_mps, 0.5 * (1 + share) * twist.angular_radps, 0.0}, dt);
    twist = {share * twist.linear_mps, share * twist.angular_radps, 0.0};
    sweep.push_back(pose);
  }
  return sweep;
}

Pose2 claimed_at(const std::vector<IntentPoint>& claim, double t_s) {
  for (std::size_t j = 1; j < claim.size(); ++j) {
    if (claim[j].offset_s < t_s) continue;
    const double span = claim[j].offset_s - claim[j - 1].offset_s;
    const double share = span > 0.0 ? std::clamp((t_s - claim[j - 1].offset_s) / span, 0.0, 1.0) : 1.0;
    const Pose2& a = claim[j - 1].base_in_map;
    const Pose2& b = claim[j].base_in_map;
    const Point2 p = a.position() + share * (b.position() - a.position());
    return {p.x, p.y, geometry::wrap(a.yaw + share * geometry::wrap(b.yaw - a.yaw))};
  }
  return claim.back().base_in_map;
}

Point2 ahead_of(const Pose2& base_in_map, double ahead_m) {
  return ahead_m == 0.0 ? base_in_map.position() : geometry::to_map(base_in_map, {ahead_m, 0.0});
}

/// The claim from now on: the place now, then what is left of the intent.
std::vector<IntentPoint> claim_of(const Peer& peer, const Pose2& base_in_map, time::Stamp now) {
  std::vector<IntentPoint> claim{{0.0, base_in_map}};
  const double age = time::seconds(now - peer.intent_arrived);
  if (age > kHonouredIntentS) return claim;
  // Drop what lies behind: up to the intent's point that is nearest to the peer within the next metres.
  std::size_t nearest = 0;
  double best = 1e18;
  for (std::size_t j = 0; j < peer.intent.size() && j < 8; ++j) {
    const double d = geometry::distance(peer.intent[j].base_in_map.position(), base_in_map.position());
    if (d < best) best = d, nearest = j;
  }
  for (std::size_t j = nearest + 1; j < peer.intent.size(); ++j)
    claim.push_back(
        {std::max(0.05, peer.intent[j].offset_s - peer.intent[nearest].offset_s), peer.intent[j].base_in_map});
  return claim;
}

bool means_to_move(Phase phase) {
  return phase == Phase::kTurning || phase == Phase::kDriving || phase == Phase::kAvoiding || phase == Phase::kBlocked;
}

}  // namespace

PeerView Observer::view(const Peer& peer, time::Stamp now) {
  PeerView view;
  const double age = time::seconds(now - peer.state_arrived);
  const bool silent = age > settings_.peer_silent_s;
  view.id = peer.id;
  view.radius_m = peer.radius_m;
  view.base_in_map =
      silent ? peer.state.base_in_map : kinematics::advance(peer.state.base_in_map, peer.state.twist, age);
  view.speed_mps = silent ? 0.0 : std::abs(peer.state.twist.linear_mps);
  view.stopping_m = kinematics::stopping_distance_m(view.speed_mps, peer.limits.max_deceleration_mps2);
  const bool yields = peer.phase == Phase::kWaiting && peer.reason == Reason::kYielding;
  view.has_goal = !silent && (means_to_move(peer.phase) || yields);
  auto [moved, first_seen] = moved_.try_emplace(peer.id, now);
  if (view.speed_mps > 0.05 || (std::abs(peer.state.twist.angular_radps) > 0.1 && !silent)) moved->second = now;
  view.standing_s = time::seconds(now - moved->second);
  view.claim = silent ? std::vector<IntentPoint>{{0.0, view.base_in_map}} : claim_of(peer, view.base_in_map, now);
  return view;
}

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

Surroundings Observer::observe(const Inputs& inputs, const std::string& own_id, double step_s, int steps,
                               time::Stamp now) {
  Surroundings out;
  for (const SeenTrack& seen : inputs.tracks) {
    Mover mover = mover_of(seen, settings_, now);
    mover.has_walked = has_walked(seen);
    out.movers.push_back(mover);
    if (mover.velocity_in_map == Point2{}) out.standing.push_back({{mover.position_in_map, mover.radius_m}, {}});
  }
  forget_all_but(inputs.tracks);
  for (const Peer& peer : inputs.peers) {
    if (peer.id == own_id) continue;
    PeerView seen = view(peer, now);
    const std::vector<Pose2> stopping_in_map = stopping_sweep(seen, peer, settings_.dead_time_s);
    std::vector<Pose2> intended_in_map;
    for (int k = 0; k <= steps; ++k)
      intended_in_map.push_back(claimed_at(seen.claim, settings_.dead_time_s + k * step_s));
    const bool stays = (!seen.has_goal && seen.speed_mps < 0.05) || seen.standing_s > settings_.peer_patience_s;
    const geometry::CoveringDiscs discs =
        geometry::covering_discs(peer.rectangle ? *peer.rectangle : geometry::disc(peer.radius_m));
    for (const double ahead_m : discs.ahead_m) {
      PeerMotion motion;
      motion.radius_m = discs.radius_m;
      for (const Pose2& pose : stopping_in_map) motion.stopping_in_map.push_back(ahead_of(pose, ahead_m));
      for (const Pose2& pose : intended_in_map) motion.intended_in_map.push_back(ahead_of(pose, ahead_m));
      if (stays) out.standing.push_back({{ahead_of(seen.base_in_map, ahead_m), discs.radius_m}, peer.id});
      out.peer_motions.push_back(std::move(motion));
    }
    out.peers.push_back(std::move(seen));
  }
  return out;
}

}  // namespace aisle::local_planner
