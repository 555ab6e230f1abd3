#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/grid/clearance.hpp"
#include "common/grid/formats/map_file.hpp"
#include "tests/support/ascii_grid.hpp"
#include "tests/support/places.hpp"

namespace aisle::global_planner::traffic {

/// A map and its clearance.
struct FloorMap {
  std::string name;
  grid::OccupancyGrid grid;
  grid::ClearanceField clearance;

  FloorMap(std::string map_name, grid::OccupancyGrid map)
      : name(std::move(map_name)), grid(std::move(map)), clearance(grid) {}

  grid::Cell high() const { return {grid.geometry().width - 1, grid.geometry().height - 1}; }
};

/// Text cells of 0.5 m, each cut into 10 x 10 cells of 0.05 m.
inline grid::OccupancyGrid half_metre_grid(const std::vector<std::string>& lines) {
  std::vector<std::string> fine;
  for (const std::string& line : lines) {
    std::string wide;
    for (const char c : line) wide += std::string(10, c);
    fine.insert(fine.end(), 10, wide);
  }
  return test_support::grid_from_text(fine, 0.05);
}

/// Two rooms and a lane of 1 m between them, with a bay of 2 m x 1.5 m.
inline FloorMap lane_with_bay() {
  return {"lane with bay", half_metre_grid({
                               "##########################################",
                               "#.......##########################.......#",
                               "#.......###########....###########.......#",
                               "#.......###########....###########.......#",
                               "#.......###########....###########.......#",
                               "#........................................#",
                               "#........................................#",
                               "#.......##########################.......#",
                               "#.......##########################.......#",
                               "#.......##########################.......#",
                               "##########################################",
                           })};
}

/// An open room.
inline FloorMap room(int width_cells = 24, int height_cells = 16) {
  std::vector<std::string> lines{std::string(static_cast<std::size_t>(width_cells + 2), '#')};
  for (int i = 0; i < height_cells; ++i)
    lines.push_back("#" + std::string(static_cast<std::size_t>(width_cells), '.') + "#");
  lines.push_back(lines.front());
  return {"room", half_metre_grid(lines)};
}

/// The maps of the demo, those made here, and those of the traffic cases where they are at hand.
inline std::vector<FloorMap> all_floors() {
  namespace fs = std::filesystem;
  std::vector<FloorMap> out{lane_with_bay(), room()};

  const auto add = [&](const fs::path& file, const grid::MapFileOptions& options) {
    out.emplace_back(file.filename().string(), grid::read_map_file(file, options));
  };
  add(test_support::source_folder() / "deploy/maps/warehouse.yaml", {});
  const fs::path cases = test_support::source_folder().parent_path() / "shared/cases/traffic/maps";
  std::vector<fs::path> texts;
  if (fs::is_directory(cases))
    for (const auto& entry : fs::directory_iterator(cases))
      if (entry.path().extension() == ".txt") texts.push_back(entry.path());
  std::sort(texts.begin(), texts.end());
  for (const fs::path& file : texts) add(file, {0.5, 10});

  return out;
}

}  // namespace aisle::global_planner::traffic
