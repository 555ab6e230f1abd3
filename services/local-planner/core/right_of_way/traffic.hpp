#pragma once

#include <limits>
#include <string>
#include <vector>

#include "services/local-planner/core/right_of_way/peers.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// Distances and times of the fleet's rules.
struct TrafficSettings {
  double look_ahead_m{12.0};
  double margin_m{0.15};   // ways of two vehicles conflict where their discs come nearer than this
  double time_gap_s{2.0};  // a vehicle that must wait goes first where it is through so long before the peer comes
  double patience_s{4.0};  // a claim of a peer that stands, not in the conflict, is honoured for so long
  double following_gap_m{0.35};
};

/// The own way: from `s_m` on, at these speeds, standing or not.
struct OwnWay {
  std::string id;
  double radius_m{0.35};
  double s_m{0.0};
  double speed_mps{0.0};
  double stopping_m{0.0};

  geometry::Point2 position_in_map;
  const Route& route;
  const std::vector<double>& profile_mps;  // at the route's points
};

/// What the fleet's rules ask of this vehicle.
struct Advice {
  double stop_at_m{std::numeric_limits<double>::infinity()};  // do not pass this s
  std::string yields_to;                                      // a peer's id; empty: none
  geometry::Point2 conflict_in_map;
  bool follows{false};                    // the stop is behind a peer that goes the same way
  std::vector<std::string> gives_way_to;  // peers that go first and claim the place where this vehicle stands
};

/// Right of way. Each vehicle decides for itself, by the same rules: two ways conflict where they come near. A vehicle
/// that is already in the conflict goes on. Otherwise, and where both are in it, the one with the smaller id goes
/// first, and the other one waits before the conflict, unless it is through well before. Behind a vehicle on the same
/// way it follows.
///
/// How: the own way is sampled every 0.2 m for 12 m; points within both radii and the margin of a peer's claim make
/// stretches of conflict; each is judged (`right_of_way` in traffic.cpp), and the nearest stop counts.
Advice advise(const OwnWay& own, const std::vector<PeerView>& peers, const TrafficSettings& settings);

/// Is the point within `distance_m` of the claimed way?
bool is_claimed(const std::vector<IntentPoint>& claim, geometry::Point2 p, double distance_m);

}  // namespace aisle::local_planner
