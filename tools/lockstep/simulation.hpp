#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "services/local-planner/core/local_planner.hpp"

namespace aisle::lockstep {

struct VehicleSetup {
  local_planner::Vehicle vehicle;
  geometry::Pose2 start_in_map;
  std::vector<geometry::Pose2> goals_in_map;    // in order
  bool heading_matters{false};
};

/// A person on a polyline, to and fro or once. Courteous ones stop short of vehicles in their way.
struct MoverSetup {
  double radius_m{0.25};
  double speed_mps{1.2};
  double start_s{0.0};
  bool loop{true};
  bool courteous{true};
  std::vector<geometry::Point2> waypoints_in_map;
};

/// A thing that the map does not show, a square.
struct BlockSetup {
  geometry::Point2 center_in_map;
  double edge_m{0.8};
  double appear_s{0.0};
};

struct EditSetup {
  double at_s{0.0};
  geometry::Point2 low_in_map, high_in_map;     // becomes occupied
};

struct Setup {
  std::string name;
  grid::OccupancyGrid grid;
  std::vector<VehicleSetup> vehicles;
  std::vector<MoverSetup> movers;
  std::vector<BlockSetup> blocks;
  std::vector<EditSetup> edits;
  std::uint64_t seed{1};
  double duration_s{300.0};
  double dead_time_s{0.1};
  double sensor_range_m{12.0};
  double state_noise_m{0.0};
  std::string planner{"wang"};                  // a variant of the global planner
  local_planner::Settings settings;
};

struct Result {
  int goals_assigned{0};
  int goals_reached{0};
  int contacts{0};
  int contacts_moving_vehicle{0};               // the vehicle was faster than 0.05 m/s
  double least_clearance_m{1e9};                // of moving vehicles to anything
  double distance_m{0.0};
  double time_s{0.0};
  int replans{0};
  int turn_sign_changes{0};
  double step_us_mean{0.0}, step_us_max{0.0};
  std::uint64_t trace_hash{0};
  std::vector<std::string> log;                 // contacts, goals missed and what the cores said, with time and vehicle
};

/// Poses of all bodies at a moment, for drawing: vehicles first.
using Watch = std::function<void(double t_s, const std::vector<geometry::Pose2>& vehicles, const std::vector<geometry::Point2>& movers,
                                 const std::vector<local_planner::Output>& outputs)>;

/// Runs the fleet with the services' own cores, in lock-step and without DDS: 50 Hz control, tracks at 10 Hz from what the
/// vehicles can see (range, walls, latency, noise), intents at 10 Hz. Ends when all goals are reached or the time is over.
/// The same setup gives the same result, but for the microseconds.
Result run(const Setup& setup, const Watch& watch = {});

}  // namespace aisle::lockstep
