#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "common/grid/clearance.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::sim {

/// Random numbers of one scenario: the same for the same seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed * 7919 + 13) {}

  /// Uniform in [low, high).
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// Uniform in 0 to count - 1.
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

 private:
  std::mt19937_64 random_;
};

/// An empty hall, walls one cell thick.
grid::OccupancyGrid hall(double width_m, double height_m, double resolution_m);

/// Occupies the cells whose centres lie in the rectangle.
void block(grid::OccupancyGrid& grid, double x0, double y0, double x1, double y1);

/// Frees them.
void carve(grid::OccupancyGrid& grid, double x0, double y0, double x1, double y1);

/// "agv-<number>", a disc, with a mission of these goals.
void add_vehicle(Setup& setup, int number, geometry::Pose2 start, std::vector<geometry::Pose2> goals,
                 double radius_m = 0.35);

/// Courteous people walk to and fro, the others once: a person that turns round on the spot, right
/// beside a vehicle, cannot be foreseen.
void add_mover(Setup& setup, double speed_mps, double start_s, bool courteous, std::vector<geometry::Point2> waypoints);

/// A free point, `room_m` from walls and away from the points given.
geometry::Pose2 free_pose(const grid::ClearanceField& clearance, Dice& dice, double room_m,
                          const std::vector<geometry::Pose2>& away_from, double away_m);

/// Vehicles anywhere, with goals anywhere.
void add_fleet(Setup& setup, Dice& dice, int count, int goals, double radius_m, double room_m, double away_m);

}  // namespace aisle::sim
