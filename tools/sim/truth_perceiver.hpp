#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "services/fake-world/core/world.hpp"
#include "services/local-planner/core/inputs.hpp"

namespace aisle::sim {

/// Where one vehicle looks from.
struct Sensor {
  std::string agv_id;
  geometry::Pose2 base_in_map;  // true
};

/// Walls, and everything that moves or stands on the floor.
struct TrueWorld {
  const grid::OccupancyGrid& walls;
  const std::vector<fake_world::Thing>& things;
};

/// The truth of what is in range and not behind walls, with noise, known a quarter of a second after it came into
/// sight.
class TruthPerceiver {
 public:
  TruthPerceiver(double range_m, std::uint64_t seed) : range_m_(range_m), random_(seed) {}

  /// `sensors`: of all vehicles; called each tenth of a second.
  void look(const std::vector<Sensor>& sensors, const TrueWorld& world, time::Stamp now);

  /// As of the last look.
  const std::vector<local_planner::SeenTrack>& tracks() const { return tracks_; }

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
  std::vector<local_planner::SeenTrack> tracks_;
};

}  // namespace aisle::sim
