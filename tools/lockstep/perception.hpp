#pragma once
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "services/fake-vehicle/core/parameters.hpp"
#include "services/obstacle-tracker/core/outbox.hpp"
#include "services/obstacle-tracker/core/tracker.hpp"
#include "tools/sim/truth_perceiver.hpp"

namespace aisle::lockstep {

using sim::Perceiver;
using sim::Sensor;
using sim::TrueWorld;
using sim::TruthPerceiver;

/// What the planners are told of how things move.
enum class Told { kAsTracked, kHeldStill };

/// Simulated lidars and the tracker's core.
class ScanPerceiver final : public Perceiver {
 public:
  /// `only_scans_of`: the one vehicle that is heard; empty: all.
  /// kHeldStill: every track where it is, with velocity 0; what driving without prediction is like.
  ScanPerceiver(const fake_vehicle::LidarParameters& lidar, std::string only_scans_of, std::uint64_t seed,
                Told told = Told::kAsTracked)
      : lidar_(lidar), only_scans_of_(std::move(only_scans_of)), random_(seed), told_(told) {}
  void look(const std::vector<Sensor>& sensors, const TrueWorld& world, time::Stamp now) override;

 private:
  fake_vehicle::LidarParameters lidar_;
  std::string only_scans_of_;
  std::mt19937_64 random_;
  Told told_;
  obstacle_tracker::Tracker tracker_;
  obstacle_tracker::Outbox outbox_;
  std::map<std::uint64_t, local_planner::SeenTrack> sent_;
};

}  // namespace aisle::lockstep
