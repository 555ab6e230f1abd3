#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::grid {

/// Cuts a grid into square tiles; the last column and row are smaller. Tile index = tile_y * tiles_x + tile_x.
struct Tiling {
  int tile_size{64};
  Geometry geometry;

  /// Tiles in a row and in a column, rounded up.
  int tiles_x() const { return (geometry.width + tile_size - 1) / tile_size; }
  int tiles_y() const { return (geometry.height + tile_size - 1) / tile_size; }
  int count() const { return tiles_x() * tiles_y(); }

  /// Lower left cell, and the cell after the upper right one.
  Cell low(int tile) const;
  Cell high(int tile) const;
};

/// The cells of a tile, row by row from the bottom. @pre 0 <= tile < tiling.count()
std::vector<Occupancy> tile_cells(const OccupancyGrid& grid, const Tiling& tiling, int tile);

/// 64-bit FNV-1a (Fowler, Noll, Vo) over the cells' bytes.
std::uint64_t tile_hash(const std::vector<Occupancy>& cells);

/// 64-bit FNV-1a over the tile hashes (8 bytes each, little endian), in tile order.
std::uint64_t map_hash(const std::vector<std::uint64_t>& tile_hashes);

}  // namespace aisle::grid
