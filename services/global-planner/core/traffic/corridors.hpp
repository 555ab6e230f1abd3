#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace aisle::global_planner::traffic {

/// Where a graph hangs together by one thread.
struct Cuts {
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  std::vector<bool> is_cut;             // without this node others lose each other
  std::vector<std::uint32_t> corridor;  // kNone, or a number: nodes all of whose edges are bridges, in connected pieces
};

/// Finds them by one depth-first walk (Tarjan 1974).
/// @param neighbours of each node, both ways; no edge twice
Cuts find_cuts(const std::vector<std::vector<std::uint32_t>>& neighbours);

}  // namespace aisle::global_planner::traffic
