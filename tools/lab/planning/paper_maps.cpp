#include "tools/lab/planning/paper_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/random_maps.hpp"

namespace aisle::lab {
namespace {

using grid::Cell;

constexpr int kColumnsToNextWall = 5;
constexpr int kFirstWall = 3;

bool is_beside(Cell cell, Cell end) { return std::max(std::abs(cell.x - end.x), std::abs(cell.y - end.y)) <= 1; }

class Drawing {
 public:
  Drawing(const PaperMapKind& kind, std::mt19937& random)
      : kind_(kind), random_(random), grid_(grid::Geometry{kind.edge, kind.edge, 1.0, {0.0, 0.0}}) {
    if (kind.has_aisles) draw_aisles();
    const int blocks = random_between(random, kind.fewest_blocks, kind.most_blocks);
    for (int i = 0; i < blocks; ++i) draw_block();
  }

  const grid::OccupancyGrid& grid() const { return grid_; }

 private:
  void occupy(Cell cell) {
    if (!is_beside(cell, kind_.start) && !is_beside(cell, kind_.goal)) grid_.set(cell, grid::Occupancy::kOccupied);
  }

  /// Walls from the bottom to the top, each with two gaps of one to three cells.
  void draw_aisles() {
    for (int x = kFirstWall; x < kind_.edge; x += kColumnsToNextWall) {
      const int first = random_between(random_, 0, kind_.edge - 3), wide = random_between(random_, 1, 3);
      const int second = random_between(random_, 0, kind_.edge - 3), as_wide = random_between(random_, 1, 3);
      for (int y = 0; y < kind_.edge; ++y) {
        const bool is_gap = (y >= first && y < first + wide) || (y >= second && y < second + as_wide);
        if (!is_gap) occupy({x, y});
      }
    }
  }

  void draw_block() {
    const int w = random_between(random_, 1, kind_.longest), h = random_between(random_, 1, kind_.longest);
    const int left = random_between(random_, 0, kind_.edge - w), low = random_between(random_, 0, kind_.edge - h);
    for (int y = low; y < low + h; ++y)
      for (int x = left; x < left + w; ++x) occupy({x, y});
  }

  const PaperMapKind& kind_;
  std::mt19937& random_;
  grid::OccupancyGrid grid_;
};

}  // namespace

const std::vector<PaperMapKind>& paper_map_kinds() {
  static const std::vector<PaperMapKind> all{
      {"li-simple", "LI table II, 10x10 simple", 10, {0, 0}, {9, 9}, 5, 8, 3},
      {"li-complex", "LI table II, 20x20 complex", 20, {0, 0}, {19, 19}, 14, 20, 4},
      {"wu", "WU figure 8", 20, {1, 1}, {18, 17}, 14, 20, 4},
      {"qu-simple", "QU table 2, 21x21 simple", 21, {5, 16}, {19, 3}, 6, 12, 7},
      {"qu-maze", "QU table 2, 21x21 maze", 21, {2, 20}, {19, 3}, 2, 5, 2, true},
      {"yu-1", "YU table 2, 20x20 scene 1", 20, {1, 2}, {18, 17}, 8, 14, 6},
      {"yu-2", "YU table 3, 20x20 scene 2", 20, {1, 1}, {17, 14}, 14, 20, 4},
      {"yu-3", "YU table 4, 50x50", 50, {4, 6}, {47, 45}, 25, 40, 12},
      {"wang-1", "WANG tables 1 and 2, 20x20", 20, {1, 1}, {19, 19}, 8, 14, 6},
      {"wang-map-1", "WANG table 3, map 1, 5 blocks", 20, {1, 1}, {19, 19}, 5, 5, 7},
      {"wang-map-2", "WANG table 3, map 2, 19 blocks", 20, {1, 1}, {19, 19}, 19, 19, 4},
      {"wang-map-3", "WANG table 3, map 3, 40x40, 74 blocks", 40, {1, 1}, {39, 39}, 74, 74, 5},
  };
  return all;
}

const PaperMapKind* find_paper_map_kind(const std::string& name) {
  for (const PaperMapKind& kind : paper_map_kinds())
    if (name == kind.name) return &kind;
  return nullptr;
}

std::string rule_of(const PaperMapKind& kind) {
  const std::string blocks = kind.fewest_blocks == kind.most_blocks
                                 ? std::to_string(kind.most_blocks)
                                 : fmt::format("{} to {}", kind.fewest_blocks, kind.most_blocks);
  return fmt::format(
      "{0} x {0} cells of 1 m, from cell ({1}, {2}) to ({3}, {4}); {5}{6} blocks with edges of 1 to {7} "
      "cells; start, goal and the cells around them stay free; drawn again until there is a way",
      kind.edge, kind.start.x, kind.start.y, kind.goal.x, kind.goal.y,
      kind.has_aisles ? "a wall in every fifth column with two gaps of 1 to 3 cells, " : "", blocks, kind.longest);
}

DrawnMap paper_map(const PaperMapKind& kind, unsigned seed) {
  std::mt19937 random(seed);
  const std::unique_ptr<global_planner::Planner> astar = global_planner::find_variant("astar")->make();
  for (;;) {
    const Drawing drawing(kind, random);
    const grid::Geometry& geometry = drawing.grid().geometry();
    DrawnMap map{drawing.grid(), geometry.center_in_map(kind.start), geometry.center_in_map(kind.goal)};
    const grid::ClearanceField clearance(map.grid, 2.0);
    const auto plan = astar->plan({clearance, map.start_in_map, map.goal_in_map}, nullptr);
    if (plan.outcome == global_planner::Outcome::kFound) return map;
  }
}

std::string text_of(const DrawnMap& map) {
  const grid::Geometry& geometry = map.grid.geometry();
  const Cell start = geometry.cell_at(map.start_in_map), goal = geometry.cell_at(map.goal_in_map);
  std::string text;
  for (int y = geometry.height - 1; y >= 0; --y) {
    for (int x = 0; x < geometry.width; ++x) {
      const Cell cell{x, y};
      text += cell == start ? 'S' : cell == goal ? 'T' : map.grid.is_free(cell) ? '.' : '#';
    }
    text += '\n';
  }
  return text;
}

}  // namespace aisle::lab
