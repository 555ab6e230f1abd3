#include "services/local-planner/core/right_of_way/stepping_aside.hpp"

#include <algorithm>

#include "services/local-planner/core/right_of_way/local_search.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kAskingM = 6.0;       // a peer farther away need not be given way yet
constexpr double kStuckWithM = 2.5;    // a peer farther away does not hold the vehicle up
constexpr double kReachM = 8.0;        // of the search, from the vehicle
constexpr double kTowardsM = 1.0;      // the lane's point so far ahead says what is left and right
constexpr double kLeastAwayM = 0.7;    // from here, where no peer asks
constexpr double kClaimSpareM = 0.05;  // besides the margin, from a claim
constexpr double kWallMarginM = 0.06;  // of the way there
constexpr double kDiscMarginM = 0.10;

bool contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// From this vehicle, between the bases.
bool is_within(double distance_m, const PeerView& peer, const Moment& moment) {
  return geometry::distance(peer.base_in_map.position(), moment.here()) < distance_m;
}

/// A peer's claim counts where it asks for room, or means to move and goes first.
bool counts(const PeerView& peer, const std::vector<std::string>& for_whom, const std::string& own_id) {
  return contains(for_whom, peer.id) || (peer.has_goal && outranks(peer.id, own_id));
}

}  // namespace

std::vector<std::string> asking_for_room(const Advice& advice, const Surroundings& around, const Moment& moment) {
  std::vector<std::string> asking;
  for (const std::string& id : advice.gives_way_to)
    for (const PeerView& peer : around.peers)
      if (peer.id == id && is_within(kAskingM, peer, moment)) asking.push_back(id);

  return asking;
}

std::vector<std::string> stuck_with(const Surroundings& around, const Moment& moment) {
  std::vector<std::string> ids;
  for (const PeerView& peer : around.peers)
    if (peer.has_goal && is_within(kStuckWithM, peer, moment)) ids.push_back(peer.id);

  return ids;
}

std::vector<Point2> way_aside(const Moment& moment, const Surroundings& around, const Way& way,
                              const std::vector<std::string>& for_whom, double margin_m) {
  if (!moment.vehicle.turns_on_the_spot()) return {};

  // Peers stand where they are, and what stands for good is in the way as well.
  std::vector<Disc> discs = around.standing_discs;
  for (const PeerView& peer : around.peers) discs.push_back({peer.base_in_map.position(), peer.radius_m});
  const Room room{*moment.inputs.clearance, discs, moment.vehicle.reach_m(), kWallMarginM, kDiscMarginM};

  const Point2 here = moment.here();

  // A place that no claim comes near to which counts.
  const auto accepts = [&](Point2 p) {
    if (for_whom.empty() && geometry::distance(p, here) < kLeastAwayM) return false;

    return std::none_of(around.peers.begin(), around.peers.end(), [&](const PeerView& peer) {
      const double least_m = moment.vehicle.reach_m() + peer.radius_m + margin_m + kClaimSpareM;
      return counts(peer, for_whom, moment.vehicle.id) && is_claimed(peer.claim, p, least_m);
    });
  };

  const Point2 towards = way.lane().at(way.lane_s_m() + kTowardsM);
  auto points = search_way(room, here, towards, kReachM, accepts);

  return points.size() < 2 ? std::vector<Point2>{} : points;
}

}  // namespace aisle::local_planner
