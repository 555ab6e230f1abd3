#pragma once

#include <string>
#include <vector>

#include "tools/lab/traffic_bounds/fleet_figures.hpp"

namespace aisle::lab {

/// Rows of cells, the first one with the names of the columns.
using Cells = std::vector<std::vector<std::string>>;

/// Goals a vehicle and hour, beside the bounds; the longest wait and stand-off.
Cells throughput_table(const FloorFigures& floor);

/// The same on the simulated site.
Cells site_table(const FloorFigures& floor);

/// Each vehicle to one goal, beside the free runs and the multi-agent plan; and plans from nothing.
Cells one_shot_table(const FloorFigures& floor);

/// Computing times. Only these differ between two runs of the same experiment.
Cells time_table(const FloorFigures& floor);

/// The longest waits and their causes, a line each; what the judge of the floor found, if anything.
std::vector<std::string> remarks(const FloorFigures& floor);

}  // namespace aisle::lab
