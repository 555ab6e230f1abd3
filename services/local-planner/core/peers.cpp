#include "services/local-planner/core/peers.hpp"

#include <cmath>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kMovingMps = 0.05;   // faster than this a peer moves,
constexpr double kMovingRadps = 0.1;  // or it turns

}  // namespace

PeerView PeerObserver::view(const Peer& peer, time::Stamp now) {
  PeerView view;
  const double age_s = time::seconds(now - peer.state_arrived);
  const bool silent = age_s > silent_s_;

  // One that fell silent is taken to stand where it was.
  view.base_in_map =
      silent ? peer.state.base_in_map : kinematics::advance(peer.state.base_in_map, peer.state.twist, age_s);
  view.speed_mps = silent ? 0.0 : std::abs(peer.state.twist.linear_mps);

  // Since when it stands: since it was first seen or last moved.
  auto [moved, first_seen] = moved_.try_emplace(peer.id, now);
  const bool turns = std::abs(peer.state.twist.angular_radps) > kMovingRadps && !silent;
  if (view.speed_mps > kMovingMps || turns) moved->second = now;
  view.standing_s = time::seconds(now - moved->second);

  return view;
}

}  // namespace aisle::local_planner
