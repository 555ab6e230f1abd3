#pragma once

#include <string>
#include <vector>

#include "tools/lab/traffic_bounds/fleet_figures.hpp"

namespace aisle::lab {

/// An SVG file's text: goals a vehicle and hour against the number of vehicles, a chart a floor: reached, the PIBT
/// bound, the free runs, and the simulated site where it was driven.
std::string throughput_svg(const std::vector<FloorFigures>& floors);

}  // namespace aisle::lab
