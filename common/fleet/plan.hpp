#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// Result of planning for a goal.
enum class PlanOutcome { kFound, kNoPath, kStartBlocked, kGoalBlocked, kOutOfMap, kOutOfTime, kCancelled };

/// Why a plan was made, or repeated.
enum class PlanTrigger { kNewGoal, kMapChanged, kVehicleBlocked, kTakeover };

/// The way of one vehicle to its goal, from the global planner: a polyline in map for the vehicle's
/// frame.
struct Plan {
  std::string agv_id;
  std::uint64_t id{0};  // counts from 1 within one life of the planner
  std::string goal_id;
  std::string map_id;
  std::uint64_t map_revision{0};  // the newest that the plan was checked against
  PlanOutcome outcome{PlanOutcome::kFound};
  PlanTrigger trigger{PlanTrigger::kNewGoal};
  std::string detail;                              // what is wrong and where; at most 256 characters
  std::string planner;                             // name of the algorithm, at most 32 characters
  geometry::Pose2 goal_in_map;                     // where the way ends: the goal, or the nearest point to it
  double position_tolerance_m{0.15};               // 0 to 100
  double yaw_tolerance_rad{0.0};                   // 0 to 7; 0: any heading
  std::vector<geometry::Point2> waypoints_in_map;  // turning points from the vehicle's place to the end, 1 to 4096;
                                                   // only a plan that was found has a way
  double length_m{0.0};                            // sum of the distances between waypoints
  double planning_ms{0.0};

  // Steps are the parts of the way that are granted one by one. A plan without traffic has none: no limit, no tube.
  std::uint64_t first_step{0};       // number of the step that begins at the first waypoint, from registration on
  std::vector<double> step_ends_m;   // where first_step, first_step + 1, ... end, along the waypoints; they do not fall
  double tube_m{0.0};                // the outline stays within this of its outline on the way; 0: any free floor
  std::vector<double> headings_rad;  // at each waypoint, of vehicles that do not turn on the spot; else empty
  std::vector<std::uint8_t> own_steps;  // 1: of the vehicle's own way, 0: of the roadmap; one a step, or none

  bool is_found() const { return outcome == PlanOutcome::kFound; }
  bool is_cancelled() const { return outcome == PlanOutcome::kCancelled; }
};

/// "goal blocked", for logs
const char* name(PlanOutcome outcome);

/// "map changed"
const char* name(PlanTrigger trigger);

}  // namespace aisle::fleet
