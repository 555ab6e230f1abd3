#pragma once
#include <string>
#include <vector>

#include "tools/lab/driving/encounters.hpp"
#include "tools/lab/planning/drawn_map.hpp"

namespace aisle::lab {

/// The way that a contestant drove, as the legend names it.
struct DrivenWay {
  std::string name;
  std::vector<geometry::Point2> in_map;
};

/// A paper's map with start and goal, the movers' ways (dashed, a disc at each end), the boxes that the map does not
/// show, and all driven ways, one colour each, named below. @returns an SVG file's text
std::string ways_svg(const std::string& title, const DrawnMap& map, const Encounters& encounters,
                     const std::vector<DrivenWay>& ways);

}  // namespace aisle::lab
