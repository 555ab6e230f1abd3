#pragma once

#include <string>
#include <vector>

#include "tools/lab/driving/fused_drive.hpp"

namespace aisle::lab {

/// A drive under the name that the legend shows.
struct NamedDrive {
  std::string name;
  const DriveFigures* figures;
};

/// Speed, turn rate and attitude (the heading in the map, without jumps at half a turn) over time, one below the other;
/// one colour a drive, with a legend. @returns an SVG file's text
std::string curves_svg(const std::string& title, const std::vector<NamedDrive>& drives);

}  // namespace aisle::lab
