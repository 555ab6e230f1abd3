#pragma once
// Grids drawn as text, for tests.
#include <stdexcept>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::test_support {

/// '#' occupied, '?' unknown, anything else free; the first line is the top row. Lower left corner at (0, 0).
inline grid::OccupancyGrid grid_from_text(const std::vector<std::string>& lines, double resolution_m = 1.0) {
  const int width = lines.empty() ? 0 : static_cast<int>(lines.front().size());
  const int height = static_cast<int>(lines.size());
  grid::OccupancyGrid grid(grid::Geometry{width, height, resolution_m, {0.0, 0.0}});
  for (int y = 0; y < height; ++y) {
    const std::string& line = lines[static_cast<std::size_t>(height - 1 - y)];
    if (static_cast<int>(line.size()) != width) throw std::invalid_argument("lines of unequal length");
    for (int x = 0; x < width; ++x) {
      const char c = line[static_cast<std::size_t>(x)];
      grid.set({x, y}, c == '#'   ? grid::Occupancy::kOccupied
                       : c == '?' ? grid::Occupancy::kUnknown
                                  : grid::Occupancy::kFree);
    }
  }
  return grid;
}

/// Centre of the cell that a letter stands in. @throws std::invalid_argument when it is not there
inline geometry::Point2 find_letter(const std::vector<std::string>& lines, char letter, double resolution_m = 1.0) {
  for (std::size_t row = 0; row < lines.size(); ++row) {
    const std::size_t x = lines[row].find(letter);
    if (x == std::string::npos) continue;
    return {(static_cast<double>(x) + 0.5) * resolution_m,
            (static_cast<double>(lines.size() - 1 - row) + 0.5) * resolution_m};
  }
  throw std::invalid_argument(std::string("no letter ") + letter);
}

}  // namespace aisle::test_support
