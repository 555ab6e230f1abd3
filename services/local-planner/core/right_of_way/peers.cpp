#include "services/local-planner/core/right_of_way/peers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kHonouredIntentS = 2.0;  // an intent that is older claims nothing
constexpr std::size_t kPassedPoints = 8;  // of an intent: its vehicle may have passed so many since it was said
constexpr double kLeastOffsetS = 0.05;    // of a claim's next point: it is not there yet
constexpr double kMovingMps = 0.05;       // faster than this a peer moves,
constexpr double kMovingRadps = 0.1;      // or it turns
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The claim from now on: the place now, then what is left of the intent.
std::vector<IntentPoint> claim_of(const Peer& peer, const Pose2& base_in_map, time::Stamp now) {
  std::vector<IntentPoint> claim{{0.0, base_in_map}};
  const double age_s = time::seconds(now - peer.intent_arrived);
  if (age_s > kHonouredIntentS) return claim;

  // Drop what lies behind: up to the intent's point that is nearest to the peer within the next metres.
  std::size_t nearest = 0;
  double best_m = kInfinity;
  for (std::size_t j = 0; j < peer.intent.size() && j < kPassedPoints; ++j) {
    const double d = geometry::distance(peer.intent[j].base_in_map.position(), base_in_map.position());
    if (d < best_m) {
      best_m = d;
      nearest = j;
    }
  }

  for (std::size_t j = nearest + 1; j < peer.intent.size(); ++j)
    claim.push_back(
        {std::max(kLeastOffsetS, peer.intent[j].offset_s - peer.intent[nearest].offset_s), peer.intent[j].base_in_map});
  return claim;
}

/// Is it under way, in this phase?
bool means_to_move(Phase phase) {
  return phase == Phase::kTurning || phase == Phase::kDriving || phase == Phase::kAvoiding || phase == Phase::kBlocked;
}

}  // namespace

PeerView PeerObserver::view(const Peer& peer, time::Stamp now) {
  PeerView view;
  const double age_s = time::seconds(now - peer.state_arrived);
  const bool silent = age_s > silent_s_;

  view.id = peer.id;
  view.radius_m = peer.radius_m;

  // One that fell silent is taken to stand where it was.
  view.base_in_map =
      silent ? peer.state.base_in_map : kinematics::advance(peer.state.base_in_map, peer.state.twist, age_s);
  view.speed_mps = silent ? 0.0 : std::abs(peer.state.twist.linear_mps);
  view.stopping_m = kinematics::stopping_distance_m(view.speed_mps, peer.limits.max_deceleration_mps2);

  // A peer that waits for others still has a goal.
  const bool yields = peer.phase == Phase::kWaiting && peer.reason == Reason::kYielding;
  view.has_goal = !silent && (means_to_move(peer.phase) || yields);

  // Since when it stands: since it was first seen or last moved.
  auto [moved, first_seen] = moved_.try_emplace(peer.id, now);
  const bool turns = std::abs(peer.state.twist.angular_radps) > kMovingRadps && !silent;
  if (view.speed_mps > kMovingMps || turns) moved->second = now;
  view.standing_s = time::seconds(now - moved->second);

  view.claim = silent ? std::vector<IntentPoint>{{0.0, view.base_in_map}} : claim_of(peer, view.base_in_map, now);

  return view;
}

Pose2 claimed_at(const std::vector<IntentPoint>& claim, double t_s) {
  for (std::size_t j = 1; j < claim.size(); ++j) {
    if (claim[j].offset_s < t_s) continue;
    const double span_s = claim[j].offset_s - claim[j - 1].offset_s;
    const double share = span_s > 0.0 ? std::clamp((t_s - claim[j - 1].offset_s) / span_s, 0.0, 1.0) : 1.0;
    const Pose2& a = claim[j - 1].base_in_map;
    const Pose2& b = claim[j].base_in_map;
    const Point2 p = a.position() + share * (b.position() - a.position());

    return {p.x, p.y, geometry::wrap(a.yaw + share * geometry::wrap(b.yaw - a.yaw))};
  }

  return claim.back().base_in_map;
}

}  // namespace aisle::local_planner
