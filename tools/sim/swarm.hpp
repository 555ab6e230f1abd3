#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/sim/site.hpp"

namespace aisle::sim {

/// One run of the swarm, all of it drawn by a seed: a floor, a fleet of 3 to 5 with a standby planner, and a plan of
/// faults in which any service crashes, hangs or is cut off, packets are lost and late, and fewer than half of the
/// vehicles die.
struct SwarmCase {
  Setup setup;
  FaultPlan plan;
  std::vector<std::string> dead;  // ids of the vehicles that die
  double last_fault_s{0.0};       // when the plan has stopped and all the dead are signed off
};

SwarmCase swarm_case(std::uint64_t seed);

/// What a run of the swarm gave.
struct SwarmVerdict {
  Outcome outcome;
  int goals{0};         // of the vehicles that live
  int reached{0};       // of them
  int closed_off{0};    // of those not reached: a dead body stands there, or in the only way; and those behind them
  double stood_s{0.0};  // from the last fault's end until a vehicle with a goal to reach moved
  std::vector<std::string> failures;  // empty: the run is good
};

/// Drives the case and judges it: no contact of a moving vehicle, no violation of authority (floor held twice among
/// them), every goal of the living reached unless it is closed off, and within kMovesAgainS of the last fault's end
/// some vehicle with a goal to reach moves. `caller`: its goes_on and says; a run that it stops is not judged.
SwarmVerdict drive_swarm_case(const SwarmCase& swarm, const Hooks& caller = {});

inline constexpr double kMovesAgainS = 5.0;

}  // namespace aisle::sim
