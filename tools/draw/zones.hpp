#pragma once

#include <string>
#include <vector>

#include "common/fleet/zone.hpp"
#include "tools/draw/map_frame.hpp"

namespace aisle::draw {

/// The map's zones, each in the colour of its kind with its id; a speed zone with its limit, a one-way zone with an
/// arrow along its direction. What they are stands under the pointer.
std::string zones_layer(const MapFrame& frame, const std::vector<fleet::Zone>& zones);

/// One entry for each kind that is among `zones`, from (x, y) to the right; empty without zones.
std::string zones_legend(int x_px, int y_px, const std::vector<fleet::Zone>& zones);

/// The map with its zones and their legend, as an SVG file's text.
std::string zones_picture(const grid::OccupancyGrid& grid, const std::vector<fleet::Zone>& zones);

}  // namespace aisle::draw
