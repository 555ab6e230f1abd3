#include "tools/lab/planning/queries.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "common/config/reader.hpp"

namespace aisle::lab {
namespace {

/// One line of a file, in cells counted from the top row.
struct Line {
  int width{0}, height{0};  // of the map that the line was made for; 0: not said
  int start_x{0}, start_y{0}, goal_x{0}, goal_y{0};
  double optimum_cells{0.0};
};

/// False when the text is no such line.
bool read_line(const std::string& text, bool is_scenario, Line& line) {
  std::istringstream in(text);
  std::string bucket, map;
  if (is_scenario && !(in >> bucket >> map >> line.width >> line.height)) return false;
  if (!(in >> line.start_x >> line.start_y >> line.goal_x >> line.goal_y >> line.optimum_cells)) return false;

  std::string rest;
  return !(in >> rest) && std::isfinite(line.optimum_cells);
}

/// Rows count from the top in the file and from the bottom in the map.
Query query_of(const Line& line, const grid::Geometry& geometry) {
  const auto center = [&](int x, int y_from_top) {
    return geometry.center_in_map({x, geometry.height - 1 - y_from_top});
  };

  return {center(line.start_x, line.start_y), center(line.goal_x, line.goal_y),
          line.optimum_cells * geometry.resolution_m};
}

/// Evenly spread, first and last included.
std::vector<Query> thinned(const std::vector<Query>& all, std::size_t limit) {
  if (all.size() <= limit) return all;
  std::vector<Query> some;
  for (std::size_t i = 0; i < limit; ++i) some.push_back(all[limit == 1 ? 0 : i * (all.size() - 1) / (limit - 1)]);
  return some;
}

}  // namespace

/// Rows count from the top in these files, and from the bottom in our maps.
std::vector<Query> read_queries(const std::filesystem::path& file, const grid::Geometry& geometry, std::size_t limit) {
  std::ifstream in(file);
  if (!in) throw config::BadInput(file.string() + ": cannot be read");

  std::vector<Query> queries;
  std::string text;
  bool is_scenario = false;

  for (std::size_t number = 1; std::getline(in, text); ++number) {
    const auto fail = [&](const std::string& why) {
      throw config::BadInput(file.string() + ":" + std::to_string(number) + ": " + why);
    };

    if (!text.empty() && text.back() == '\r') text.pop_back();

    if (number == 1 && text.rfind("version", 0) == 0) {
      is_scenario = true;
      continue;
    }

    if (text.find_first_not_of(" \t") == std::string::npos) continue;

    Line line;
    if (!read_line(text, is_scenario, line)) {
      fail(is_scenario ? "expected bucket, map, width, height, start x y, goal x y and optimal length"
                       : "expected start x y, goal x y and optimal length");
    }

    if (is_scenario && (line.width != geometry.width || line.height != geometry.height)) {
      fail("is for a map of " + std::to_string(line.width) + " x " + std::to_string(line.height) +
           " cells, this one has " + std::to_string(geometry.width) + " x " + std::to_string(geometry.height));
    }

    for (const grid::Cell c : {grid::Cell{line.start_x, line.start_y}, grid::Cell{line.goal_x, line.goal_y}}) {
      if (!geometry.contains(c))
        fail("cell " + std::to_string(c.x) + " " + std::to_string(c.y) + " is outside the map");
    }

    queries.push_back(query_of(line, geometry));
  }

  if (queries.empty()) throw config::BadInput(file.string() + ": has no scenario");

  return thinned(queries, limit);
}

}  // namespace aisle::lab
