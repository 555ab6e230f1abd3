#include "tools/lab/planning/drawn_map.hpp"

#include <sstream>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/grid/formats/map_image.hpp"
#include "common/grid/formats/picture_map.hpp"

namespace aisle::lab {
namespace {

/// Without their ends and without empty lines at the end of the file.
std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream in(grid::read_bytes(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();

  return lines;
}

/// Fills one cell.
void draw(char c, grid::Cell cell, LabMap& map) {
  if (c == '#') map.grid.set(cell, grid::Occupancy::kOccupied);
  if (c == '?') map.grid.set(cell, grid::Occupancy::kUnknown);
  if (c == 'S') map.start_in_map = map.grid.geometry().center_in_map(cell);
  if (c == 'T') map.goal_in_map = map.grid.geometry().center_in_map(cell);
}

/// "line 2, column 3", counted from 1.
std::string place(std::size_t row, std::size_t column) {
  return "line " + std::to_string(row + 1) + ", column " + std::to_string(column + 1);
}

/// Row 0 of the file is the top row of the map. `known` has the characters that it may hold.
LabMap read_text_map(const std::filesystem::path& file, double cell_m, const std::string& known) {
  const std::vector<std::string> lines = lines_of(file);
  const auto fail = [&](std::size_t line, const std::string& why) {
    throw config::BadInput(file.string() + ":" + std::to_string(line + 1) + ": " + why);
  };

  if (lines.empty() || lines.front().empty()) fail(0, "an empty map");
  const std::size_t width = lines.front().size();
  grid::require_map_size(file, static_cast<long long>(width), static_cast<long long>(lines.size()), 1);

  const int height = static_cast<int>(lines.size());
  LabMap map{grid::OccupancyGrid(grid::Geometry{static_cast<int>(width), height, cell_m, {}})};

  for (std::size_t row = 0; row < lines.size(); ++row) {
    if (lines[row].size() != width) fail(row, "is not as long as the first line");

    for (std::size_t x = 0; x < width; ++x) {
      const char c = lines[row][x];
      if ((c == 'S' && map.start_in_map) || (c == 'T' && map.goal_in_map))
        fail(row, std::string("a second '") + c + "': a map has one start S and one goal T");
      if (known.find(c) == std::string::npos)
        grid::reject(file, place(row, x) + ": '" + c + "' is not one of " + known);
      draw(c, {static_cast<int>(x), height - 1 - static_cast<int>(row)}, map);
    }
  }

  return map;
}

}  // namespace

DrawnMap read_drawn_map(const std::filesystem::path& file, double cell_m) {
  LabMap map = read_text_map(file, cell_m, "#.ST");
  if (!map.start_in_map || !map.goal_in_map)
    throw config::BadInput(file.string() + ": no start S or no goal T in the map");

  return {std::move(map.grid), *map.start_in_map, *map.goal_in_map};
}

LabMap read_lab_map(const std::filesystem::path& file, double cell_m) {
  if (grid::is_picture(file)) return {grid::read_picture_map(file, cell_m)};

  const std::string ending = file.extension().string();
  if ((ending == ".yaml" || ending == ".yml") && cell_m > 0.0)
    throw config::BadInput(file.string() + ": a ROS map says its resolution itself: leave out --resolution");

  const double stated_m = cell_m > 0.0 ? cell_m : 1.0;
  if (ending == ".txt") return read_text_map(file, stated_m, "#.?ST");
  if (ending == ".map" || ending == ".yaml" || ending == ".yml") return {grid::read_map_file(file, {stated_m, 1})};

  throw config::BadInput(file.string() + ": ending '" + ending +
                         "' is no known map: .png or .pgm (picture), .yaml (ROS), .map (Moving AI), .txt (text)");
}

}  // namespace aisle::lab
