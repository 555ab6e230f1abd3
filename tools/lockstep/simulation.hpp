#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/scenario/scenario.hpp"
#include "services/fake-vehicle/core/parameters.hpp"
#include "services/fake-world/core/recording.hpp"
#include "services/local-planner/core/local_planner.hpp"

namespace aisle::lockstep {

/// What the fleet knows of people and things: from simulated scans and the tracker, the same but every track held still
/// (nothing is predicted), or the truth of what is in sight.
enum class Perception { kScans, kScansHeldStill, kTruth };

struct Setup {
  scenario::Scenario scenario;  // its map and its recordings come beside it, read
  grid::OccupancyGrid grid;
  std::vector<std::vector<fake_world::RecordedPerson>> people;  // of each recording
  fake_vehicle::Parameters vehicle;                             // radius and top speed come from the scenario
  Perception perception{Perception::kScans};
  std::string only_scans_of{};                          // the one vehicle whose scans the tracker takes; empty: all
  std::string planner{"direct"};                        // a variant of the global planner
  std::string local{"wang"};                            // of the local planner
  std::optional<local_planner::Variant> own_variant{};  // instead of `local`
  bool paper_limits{false};                             // vehicles and horizon as in the paper of `local`
  local_planner::Settings settings;
  std::uint64_t seed{1};
};

/// A vehicle touches something, from one look of the judge to the next.
struct Touch {
  double t_s{0.0};
  std::string vehicle;
  std::string other;           // a vehicle, a thing, or "wall"
  geometry::Point2 at_in_map;  // of the vehicle
  bool begins{true};           // else they touch already, and now the vehicle moves
  bool is_moving{false};       // the vehicle was faster than 0.05 m/s
};

inline constexpr double kNothingNearM = 1e9;

struct Result {
  int goals_assigned{0};
  int goals_reached{0};
  int contacts{0};                 // beginnings of contacts, of each vehicle
  int contacts_moving_vehicle{0};  // the vehicle was faster than 0.05 m/s
  std::vector<Touch> touches;
  double least_clearance_m{kNothingNearM};  // of moving vehicles to anything within 2 m
  double distance_m{0.0};
  double time_s{0.0};
  std::vector<int> reached;    // goals of each vehicle
  std::vector<int> replanned;  // how often
  std::vector<double> done_s;  // of each vehicle: when its last goal was reached; -1: never
  double planned_m{0.0};       // length of the first plan of each goal
  int replans{0};
  int turn_sign_changes{0};      // of turn rates beyond 0.05 rad/s: dithering
  double jerk_squared_sum{0.0};  // (m/s^3)^2 of each vehicle and control period, of true speeds
  std::uint64_t jerk_samples{0};
  double step_us_mean{0.0}, step_us_max{0.0};  // CPU time of the local planner's cycles
  std::uint64_t trace_hash{0};
  std::vector<std::string> log;  // contacts, goals missed and what the cores said, with time and vehicle
};

/// Does a line of the log tell of a contact or of a goal that was missed?
bool is_verdict(const std::string& line);

/// What can be seen at a moment, for traces and drawings. Vehicles and outputs in the scenario's order.
struct Snapshot {
  double t_s{0.0};
  std::vector<geometry::Pose2> vehicles;
  std::vector<local_planner::Output> outputs;
  std::vector<geometry::Body> things;
  std::vector<local_planner::SeenTrack> tracks;
  std::vector<const fleet::Plan*> plans;  // of each vehicle, valid while it is looked at; null: none yet
};
using Watch = std::function<void(const Snapshot&)>;

/// Runs a scenario with the services' own cores, in lock-step and without DDS: vehicles, lidars and people of the
/// simulation, tracker, both planners; 50 Hz control, 10 Hz scans, 10 Hz status. Ends when all goals are reached or the
/// time is over. The same setup gives the same result, but for the microseconds.
/// @param goes_on asked each simulated second, with the time; where it says no, the run ends there
Result run(const Setup& setup, const Watch& watch = {}, const std::function<bool(double t_s)>& goes_on = {});

}  // namespace aisle::lockstep
