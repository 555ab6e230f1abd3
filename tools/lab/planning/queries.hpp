#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {

/// One question to a planner, with the answer's optimal length where the file knows it.
struct Query {
  geometry::Point2 start_in_map;
  geometry::Point2 goal_in_map;
  double optimum_m{0.0};  // 8-connected, no corner cut, for a point; 0: not known
};

/// Reads scenarios of Moving AI (`version 1`, then bucket, map, width, height, start, goal, optimum) or lines of
/// `sx sy gx gy optimum` (`.q`), in cells of the map counted from the top row; start and goal become the centres of
/// their cells. At most `limit`, evenly spread over the file.
/// @throws config::BadInput with file and line: not such a file, a map of another size, a cell outside it
std::vector<Query> read_queries(const std::filesystem::path& file, const grid::Geometry& geometry, std::size_t limit);

}  // namespace aisle::lab
