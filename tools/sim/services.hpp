#pragma once
#include <vector>

#include "tools/lockstep/simulation.hpp"
#include "tools/sim/process.hpp"

namespace aisle::sim {

/// The processes that drive a scenario, in the order of their start: all but the referee, which the site has itself.
/// `setup` must outlive them.
std::vector<Blueprint> blueprints_of(const lockstep::Setup& setup);

}  // namespace aisle::sim
