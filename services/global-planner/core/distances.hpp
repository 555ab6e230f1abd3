#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "common/grid/occupancy_grid.hpp"
#include "services/global-planner/core/search_memory.hpp"

// Distances between cells in cost units (kStraightCost a cell), as heuristics use them. All but Manhattan's never
// overestimate.
namespace aisle::global_planner {

/// Shortest way of 8 neighbours: straight and diagonal steps.
inline std::uint32_t octile(grid::Cell a, grid::Cell b) {
  const auto dx = static_cast<std::uint32_t>(std::abs(a.x - b.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(a.y - b.y));

  return kStraightCost * std::max(dx, dy) + (kDiagonalCost - kStraightCost) * std::min(dx, dy);
}

/// The greater of both differences.
inline std::uint32_t chebyshev(grid::Cell a, grid::Cell b) {
  return kStraightCost * static_cast<std::uint32_t>(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)));
}

/// In cells, not in cost units.
inline float euclidean_cells(grid::Cell a, grid::Cell b) {
  const auto dx = static_cast<float>(a.x - b.x);
  const auto dy = static_cast<float>(a.y - b.y);

  return std::sqrt(dx * dx + dy * dy);
}

/// The sum of both differences, in cells.
inline float manhattan_cells(grid::Cell a, grid::Cell b) {
  return static_cast<float>(std::abs(a.x - b.x) + std::abs(a.y - b.y));
}

/// Euclidean, rounded down.
inline std::uint32_t euclidean(grid::Cell a, grid::Cell b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;

  return static_cast<std::uint32_t>(std::sqrt(dx * dx + dy * dy) * kStraightCost);
}

// The same by name, as a search's parameter: in cells, and in cost units rounded down.
struct Euclid {
  static float cells(grid::Cell a, grid::Cell b) { return euclidean_cells(a, b); }
  static std::uint32_t cost(grid::Cell a, grid::Cell b) { return euclidean(a, b); }
};
struct Manhattan {
  static float cells(grid::Cell a, grid::Cell b) { return manhattan_cells(a, b); }
  static std::uint32_t cost(grid::Cell a, grid::Cell b) {
    return kStraightCost * static_cast<std::uint32_t>(std::abs(a.x - b.x) + std::abs(a.y - b.y));
  }
};
struct Chebyshev {
  static float cells(grid::Cell a, grid::Cell b) {
    return static_cast<float>(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)));
  }
  static std::uint32_t cost(grid::Cell a, grid::Cell b) { return chebyshev(a, b); }
};
struct OctileDistance {
  static float cells(grid::Cell a, grid::Cell b) {
    return static_cast<float>(octile(a, b)) / static_cast<float>(kStraightCost);
  }
  static std::uint32_t cost(grid::Cell a, grid::Cell b) { return octile(a, b); }
};

/// cost + a weighted heuristic in cells, as an evaluation: rounded down, at most 4e9.
inline std::uint32_t evaluated(std::uint32_t cost, float weighted_cells) {
  return static_cast<std::uint32_t>(
      std::min(static_cast<double>(cost) + static_cast<double>(weighted_cells) * kStraightCost, 4e9));
}

}  // namespace aisle::global_planner
