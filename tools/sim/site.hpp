#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/referee/core/run_report.hpp"
#include "tools/sim/fault_plan.hpp"
#include "tools/sim/result.hpp"
#include "tools/sim/setup.hpp"
#include "tools/sim/snapshot.hpp"

namespace aisle::sim {

/// What goes wrong in a run, and by which seed. The seed draws which processes are hit and which packets.
struct Faults {
  FaultPlan plan;
  std::uint64_t seed{1};
};

/// What a run gave. `report` is the referee's; `result` repeats its counts beside the figures of how vehicles drove.
struct Outcome {
  Result result;
  referee::RunReport report;
  std::map<std::string, std::uint64_t> faults;  // what was done, by kind: "crash", "lost_packets", ...
  std::uint64_t messages{0};                    // samples handed to services
};

/// What a caller hears of a run. Each may be empty; none changes the run, but that `goes_on` may end it.
struct Hooks {
  std::function<bool(double t_s)> goes_on{};            // asked each simulated second; false: the run ends there
  std::function<void(const std::string& line)> says{};  // what is done to the site, and what services log
  Watch watch{};                                        // ten times a simulated second, once all vehicles are there
  std::function<void(const Cycle&)> on_cycle{};         // in each cycle of each local planner, as for `watch`
};

/// Runs a scenario with all its services, as they are, on a simulated network in this thread: map, planners, tracker
/// (or its stand-in, Perception::kTruth), fake vehicles and world, dispatcher, referee. Ends when the referee says so,
/// when the scenario's time is over, or when `hooks.goes_on` says no. The same setup and faults give the same outcome
/// to the bit, whatever other threads drive meanwhile.
///
/// @throws config::BadInput for a fault plan that names a process which does not exist
Outcome drive(const Setup& setup, const Faults& faults = {}, const Hooks& hooks = {});

}  // namespace aisle::sim
