#include "tools/lab/planning/drawn_map.hpp"

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/config/reader.hpp"

namespace aisle::lab {

/// Row 0 of the file is the top row of the map.
DrawnMap read_drawn_map(const std::filesystem::path& file, double cell_m) {
  std::ifstream in(file);
  if (!in) throw config::BadInput(file.string() + ": cannot be read");

  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const auto fail = [&](std::size_t line, const std::string& why) {
    throw config::BadInput(file.string() + ":" + std::to_string(line + 1) + ": " + why);
  };

  if (lines.empty() || lines.front().empty()) fail(0, "an empty map");

  const int height = static_cast<int>(lines.size());
  DrawnMap map{grid::OccupancyGrid(grid::Geometry{static_cast<int>(lines.front().size()), height, cell_m, {}}), {}, {}};
  std::optional<geometry::Point2> start, goal;

  for (std::size_t row = 0; row < lines.size(); ++row) {
    if (lines[row].size() != lines.front().size()) fail(row, "is not as long as the first line");

    for (std::size_t x = 0; x < lines[row].size(); ++x) {
      const grid::Cell cell{static_cast<int>(x), height - 1 - static_cast<int>(row)};
      const char c = lines[row][x];

      if (c == '#') map.grid.set(cell, grid::Occupancy::kOccupied);
      if (c == 'S') start = map.grid.geometry().center_in_map(cell);
      if (c == 'T') goal = map.grid.geometry().center_in_map(cell);
      if (std::string("#.ST").find(c) == std::string::npos) fail(row, std::string("'") + c + "' is not one of #.ST");
    }
  }

  if (!start || !goal) fail(lines.size() - 1, "no start S or no goal T in the map");
  map.start_in_map = *start;
  map.goal_in_map = *goal;

  return map;
}

}  // namespace aisle::lab
