#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/local-planner/core/inputs.hpp"

namespace aisle::local_planner {

/// Another vehicle of the fleet as this cycle sees it.
struct PeerView {
  std::string id;
  double radius_m{0.35};
  geometry::Pose2 base_in_map;  // now
  double speed_mps{0.0};
  double stopping_m{0.0};
  double standing_s{0.0};          // how long it has stood
  bool has_goal{false};            // means to move on
  std::vector<IntentPoint> claim;  // from now on; the first is where it is
};

/// Remembers since when each peer stands.
class PeerObserver {
 public:
  /// @param silent_s after so long without a state the peer is taken to stand where it was
  explicit PeerObserver(double silent_s) : silent_s_(silent_s) {}

  /// The peer's newest samples, carried on to `now`.
  PeerView view(const Peer& peer, time::Stamp now);

 private:
  double silent_s_;
  std::map<std::string, time::Stamp> moved_;  // when each peer last moved
};

/// Where the claim says that the peer is `t_s` from now; beyond its end: the end. @pre not empty
geometry::Pose2 claimed_at(const std::vector<IntentPoint>& claim, double t_s);

}  // namespace aisle::local_planner
