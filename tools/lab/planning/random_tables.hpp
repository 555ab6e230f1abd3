#pragma once

#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// On 200 random block maps of 20x20, 8 to 19 blocks, corner to corner: in how many of them each paper's planner is
/// better than its baseline as drawn, and than an A* that cuts no corner.
std::string block_direction_table(const Progress& progress);

/// Expanded cells on 200 random block maps of 20x20, 8 to 19 blocks, corner to corner, against the papers' baseline
/// (Chebyshev, corners cut): quartiles a planner.
std::string block_map_table(const Progress& progress);

/// `maps` random maps of 20 to 200 cells' edge with this share of occupied cells, corner to corner: figures a planner,
/// and in how many of them it is better than an A* that cuts no corner.
std::string random_map_table(int occupied_percent, int maps, const Progress& progress);

}  // namespace aisle::lab
