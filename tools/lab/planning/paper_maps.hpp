#pragma once
#include <string>
#include <vector>

#include "tools/lab/planning/drawn_map.hpp"

namespace aisle::lab {

/// Of what kind a paper's map is: the papers print pictures, so maps of the same size, start, goal and kind are drawn
/// by seed. Cells of 1 m.
struct PaperMapKind {
  const char* name;   // "wang-1", as in deploy/experiments
  const char* paper;  // "WANG tables 1 and 2, 20x20"
  int edge;           // cells
  grid::Cell start, goal;
  int fewest_blocks, most_blocks;
  int longest;             // edge of a block, cells
  bool has_aisles{false};  // QU's maze: a wall in every fifth column, beside the blocks
};

const std::vector<PaperMapKind>& paper_map_kinds();

/// Null when there is none of this name.
const PaperMapKind* find_paper_map_kind(const std::string& name);

/// How such maps are drawn, in one sentence.
std::string rule_of(const PaperMapKind& kind);

/// The map of this kind and seed, the same on every machine: drawn by rule_of, and drawn again until there is a way
/// that cuts no corner.
DrawnMap paper_map(const PaperMapKind& kind, unsigned seed);

/// The map as text, as read_drawn_map reads it.
std::string text_of(const DrawnMap& map);

}  // namespace aisle::lab
