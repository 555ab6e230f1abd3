#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/sim/process.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::sim {

/// Called with the decision of a vehicle's local planner in each of its cycles, and with the CPU time that it took.
using HearsCycle =
    std::function<void(const std::string& agv_id, const local_planner::Output& output, double compute_us)>;

/// The processes that drive a scenario, in the order of their start: all but the referee, which the site has itself.
/// `setup` must outlive them. `hears_cycle` may be empty.
std::vector<Blueprint> blueprints_of(const Setup& setup, const HearsCycle& hears_cycle = {});

}  // namespace aisle::sim
