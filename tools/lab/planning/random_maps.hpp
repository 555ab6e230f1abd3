#pragma once

// Random maps by seed: the same on every machine (only the engine's own numbers are used).

#include <cstdint>
#include <random>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {

/// A whole number in [low, high].
inline int random_between(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint32_t>(high - low + 1));
}

/// Each cell is occupied with this chance in percent.
inline grid::OccupancyGrid random_cells(std::mt19937& random, int width, int height, int occupied_percent,
                                        double resolution_m = 1.0) {
  grid::OccupancyGrid grid(grid::Geometry{width, height, resolution_m, {0.0, 0.0}});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (random_between(random, 0, 99) < occupied_percent) grid.set({x, y}, grid::Occupancy::kOccupied);
    }
  }

  return grid;
}

/// `blocks` rectangles with edges of 1 to `longest` cells, that leave the lower left and upper right corner free.
inline grid::OccupancyGrid random_blocks(std::mt19937& random, int edge, int blocks, int longest,
                                         double resolution_m = 1.0) {
  grid::OccupancyGrid grid(grid::Geometry{edge, edge, resolution_m, {0.0, 0.0}});
  for (int i = 0; i < blocks; ++i) {
    const int w = random_between(random, 1, longest);
    const int h = random_between(random, 1, longest);
    const int x0 = random_between(random, 0, edge - w);
    const int y0 = random_between(random, 0, edge - h);

    for (int y = y0; y < y0 + h; ++y) {
      for (int x = x0; x < x0 + w; ++x) {
        const bool is_corner = (x < 2 && y < 2) || (x >= edge - 2 && y >= edge - 2);
        if (!is_corner) grid.set({x, y}, grid::Occupancy::kOccupied);
      }
    }
  }

  return grid;
}

}  // namespace aisle::lab
