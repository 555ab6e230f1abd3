#pragma once

#include <map>
#include <string>

#include "services/local-planner/core/inputs.hpp"

namespace aisle::local_planner {

/// Another vehicle of the fleet as this cycle sees it.
struct PeerView {
  geometry::Pose2 base_in_map;  // now
  double speed_mps{0.0};
  double standing_s{0.0};  // how long it has stood
};

/// Remembers since when each peer stands.
class PeerObserver {
 public:
  /// @param silent_s after so long without a state the peer is taken to stand where it was
  explicit PeerObserver(double silent_s) : silent_s_(silent_s) {}

  /// The peer's newest sample, carried on to `now`.
  PeerView view(const Peer& peer, time::Stamp now);

 private:
  double silent_s_;
  std::map<std::string, time::Stamp> moved_;  // when each peer last moved
};

}  // namespace aisle::local_planner
