#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "services/fake-vehicle/core/simulated_vehicle.hpp"
#include "tools/sim/process.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::sim {

/// Called with the decision of a vehicle's local planner in each of its cycles, and with the CPU time that it took.
using HearsCycle =
    std::function<void(const std::string& agv_id, const local_planner::Output& output, double compute_us)>;

/// What hinders each vehicle now, by its id. Read by the vehicles in each of their cycles.
using Hindrances = std::map<std::string, fake_vehicle::Hindrance>;

/// The processes that drive a scenario, in the order of their start: all but the referee, which the site has itself.
/// `setup` and `hindrances`, which gets an entry a vehicle, must outlive them. `hears_cycle` may be empty.
std::vector<Blueprint> blueprints_of(const Setup& setup, Hindrances& hindrances, const HearsCycle& hears_cycle = {});

}  // namespace aisle::sim
