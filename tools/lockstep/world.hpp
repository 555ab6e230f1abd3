#pragma once
#include <cstdint>
#include <random>
#include <vector>

#include "services/local-planner/core/inputs.hpp"
#include "tools/lockstep/simulation.hpp"

namespace aisle::lockstep {

/// A body on wheels: applies commands after the dead time, within the vehicle's limits.
class Wheels {
 public:
  Wheels(const VehicleSetup& setup, double dead_time_s);
  void step(const geometry::Twist2& command, double dt_s);
  const geometry::Pose2& base_in_map() const { return base_in_map_; }
  const geometry::Twist2& twist() const { return twist_; }

 private:
  kinematics::Limits limits_;
  geometry::Pose2 base_in_map_;
  geometry::Twist2 twist_;
  std::vector<geometry::Twist2> pipe_;
  double dead_time_s_;
};

class Walker {
 public:
  explicit Walker(const MoverSetup& setup);
  /// Courteous walkers look at these discs (x, y, radius).
  void step(double t_s, double dt_s, const std::vector<local_planner::Disc>& vehicles);
  geometry::Point2 position_in_map() const { return position_; }
  geometry::Point2 velocity_in_map() const { return velocity_; }
  bool is_present() const { return present_; }
  double radius_m() const { return setup_.radius_m; }

 private:
  MoverSetup setup_;
  geometry::Point2 position_, velocity_;
  std::size_t next_{1};
  int direction_{1};
  bool present_{false};
};

/// Ground truth seen as a tracker would: only what a vehicle's ray can reach, with noise, and only after some scans.
class PerfectTracker {
 public:
  PerfectTracker(double range_m, std::uint64_t seed) : range_m_(range_m), random_(seed) {}
  struct Body {
    geometry::Point2 position, velocity;
    double radius_m;
    bool present;
  };
  /// Call at 10 Hz with the same bodies in the same order.
  void scan(const std::vector<Body>& bodies, const std::vector<geometry::Pose2>& sensors, const grid::OccupancyGrid& grid);
  const std::vector<local_planner::SeenTrack>& tracks() const { return tracks_; }

 private:
  struct Memory {
    double seen_s{0.0}, lost_s{1e9}, standing_s{0.0};
    geometry::Point2 position, velocity;
  };
  double range_m_;
  std::mt19937_64 random_;
  std::vector<Memory> memory_;
  std::vector<local_planner::SeenTrack> tracks_;
};

/// Exact distance from a point to the nearest occupied square cell, up to 2 m.
double distance_to_walls_m(const grid::OccupancyGrid& grid, geometry::Point2 p);
double distance_to_square_m(geometry::Point2 p, geometry::Point2 center, double edge_m);

}  // namespace aisle::lockstep
