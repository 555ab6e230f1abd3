#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/fleet/plan.hpp"
#include "common/fleet/track.hpp"
#include "common/geometry/body.hpp"
#include "services/local-planner/core/local_planner.hpp"

namespace aisle::sim {

/// What can be seen at a moment of a run, for traces and drawings. Vehicles, outputs and plans are in the scenario's
/// order.
struct Snapshot {
  double t_s{0.0};                               // since the start of the run
  std::vector<geometry::Pose2> vehicles_in_map;  // true bases
  std::vector<local_planner::Output> outputs;    // of each local planner's newest cycle
  std::vector<geometry::Body> things;            // people and blocks, in the order of their ids
  std::vector<fleet::Track> tracks;              // that live, as they were last told
  std::vector<const fleet::Plan*> plans;         // valid while it is looked at; null: none yet
};

/// One cycle of a vehicle's local planner. Valid while it is looked at.
struct Cycle {
  double t_s;                           // since the start of the run
  const std::string& agv_id;            // "agv-1"
  const geometry::Pose2& base_in_map;   // true
  const local_planner::Output& output;  // what was decided
  double compute_us;                    // CPU time of the planner; it alone differs from run to run
  const Snapshot& around;               // of this moment
};

/// Called with a snapshot during a run; the plans it points to are valid only until the call returns.
using Watch = std::function<void(const Snapshot&)>;

}  // namespace aisle::sim
