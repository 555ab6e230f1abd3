#pragma once
#include <functional>
#include <string>
#include <vector>

#include "common/geometry/body.hpp"
#include "services/local-planner/core/local_planner.hpp"
#include "tools/sim/result.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::lockstep {

using sim::kNothingNearM;
using sim::Perception;
using sim::Result;
using sim::Setup;
using sim::Touch;

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
