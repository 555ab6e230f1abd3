#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/fake-world/core/world.hpp"
#include "services/local-planner/core/inputs.hpp"

namespace aisle::sim {

/// The sensors of one vehicle, as the tracker knows it.
struct Sensor {
  std::string agv_id;
  geometry::Pose2 base_in_map;  // true
  geometry::Pose2 believed_in_map;
  geometry::Twist2 twist;
  geometry::Footprint footprint;
};

/// Walls, and everything that moves or stands on the floor.
struct TrueWorld {
  const grid::OccupancyGrid& walls;
  const grid::ClearanceField& clearance;
  const std::vector<fake_world::Thing>& things;
};

/// Gives the planners tracks after the scans of all vehicles of one moment.
class Perceiver {
 public:
  virtual ~Perceiver() = default;

  /// `sensors`: of all vehicles; called each tenth of a second.
  virtual void look(const std::vector<Sensor>& sensors, const TrueWorld& world, time::Stamp now) = 0;

  /// As of the last look.
  const std::vector<local_planner::SeenTrack>& tracks() const { return tracks_; }

 protected:
  std::vector<local_planner::SeenTrack> tracks_;
};

/// The truth of what is in range and not behind walls, with noise, known a quarter of a second after it came into
/// sight.
class TruthPerceiver final : public Perceiver {
 public:
  TruthPerceiver(double range_m, std::uint64_t seed) : range_m_(range_m), random_(seed) {}
  void look(const std::vector<Sensor>& sensors, const TrueWorld& world, time::Stamp now) override;

 private:
  /// What is remembered of one thing in sight, or just lost.
  struct Memory {
    std::uint64_t id{0};
    double seen_s{0.0}, lost_s{0.0}, standing_s{0.0};
    geometry::Point2 position, velocity;
    double radius_m{0.25};
  };

  double range_m_;
  std::mt19937_64 random_;
  std::map<std::string, Memory> memory_;
  std::uint64_t next_id_{1};
};

}  // namespace aisle::sim
