#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/fleet/obstacle.hpp"
#include "common/service/shell.hpp"
#include "tools/sim/truth_perceiver.hpp"

namespace aisle::sim {

/// Stands in for the obstacle tracker: writes `track` and `tracking_status` from the ground truth of
/// things in sight of a vehicle, with noise, a quarter of a second after they came into sight. Lists
/// each vehicle's scans in the status, as the tracker does, but reads nothing in them.
class TruthTracker {
 public:
  /// @param range_m how far vehicles see
  TruthTracker(service::Shell& shell, double range_m, std::uint64_t seed);
  TruthTracker(const TruthTracker&) = delete;
  TruthTracker& operator=(const TruthTracker&) = delete;

 private:
  void take(const fleet::Obstacle& obstacle);
  void tick();
  void look();
  void tell();

  service::Shell& shell_;
  service::MapClient& map_;
  service::Outbox<topics::Track> tracks_;
  service::Outbox<topics::TrackingStatus> statuses_;
  TruthPerceiver perceiver_;
  std::map<std::string, Sensor> sensors_;               // of each vehicle whose ground truth came
  std::map<std::string, fleet::ScanUse> newest_scans_;  // of each vehicle
  std::map<std::string, fake_world::Thing> things_;
  std::set<std::uint64_t> live_;  // tracks that were told and not given up
  int ticks_{0};
};

}  // namespace aisle::sim
