#pragma once

#include <optional>
#include <string>

#include "services/local-planner/core/critic.hpp"
#include "tools/lab/planning/drawn_map.hpp"
#include "tools/sim/setup.hpp"

namespace aisle::lab {

/// A drive as the paper of `variant` prints it: its vehicle goes from S to T of `map` along the way of the global
/// planner `global`, with nothing of ours in between (PrintedPlanner, FleetSettings::as_printed). Tracks are the truth,
/// since the papers' simulations know their obstacles; the goal is reached within 0.5 m of it, at any speed and
/// heading. `start_yaw_rad` in map; none: the one that the paper prints, else towards the goal.
sim::Setup printed_setup(const DrawnMap& map, const local_planner::Variant& variant, const std::string& global,
                         std::optional<double> start_yaw_rad = {});

/// The global planner of the same paper; for a variant without one, `direct`.
std::string global_planner_of(const local_planner::Variant& variant);

}  // namespace aisle::lab
