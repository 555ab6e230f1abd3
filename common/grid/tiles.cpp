#include "common/grid/tiles.hpp"

#include <algorithm>

namespace aisle::grid {
namespace {

/// FNV-1a of 64 bits: for each byte, hash = (hash xor byte) * prime.
constexpr std::uint64_t kFnvOffset = 14695981039346656037ULL;
constexpr std::uint64_t kFnvPrime = 1099511628211ULL;

}  // namespace

Cell Tiling::low(int tile) const { return {tile % tiles_x() * tile_size, tile / tiles_x() * tile_size}; }

Cell Tiling::high(int tile) const {
  const Cell from = low(tile);
  return {std::min(from.x + tile_size, geometry.width), std::min(from.y + tile_size, geometry.height)};
}

/// Row by row, each in one piece.
std::vector<Occupancy> tile_cells(const OccupancyGrid& grid, const Tiling& tiling, int tile) {
  const Cell low = tiling.low(tile);
  const Cell high = tiling.high(tile);
  std::vector<Occupancy> cells;

  cells.reserve(static_cast<std::size_t>(high.x - low.x) * static_cast<std::size_t>(high.y - low.y));

  for (int y = low.y; y < high.y; ++y) {
    const auto row = grid.cells().begin() + static_cast<std::ptrdiff_t>(grid.geometry().index({low.x, y}));
    cells.insert(cells.end(), row, row + (high.x - low.x));
  }

  return cells;
}

std::uint64_t tile_hash(const std::vector<Occupancy>& cells) {
  std::uint64_t hash = kFnvOffset;
  for (const Occupancy cell : cells) hash = (hash ^ static_cast<std::uint8_t>(cell)) * kFnvPrime;
  return hash;
}

std::uint64_t map_hash(const std::vector<std::uint64_t>& tile_hashes) {
  std::uint64_t hash = kFnvOffset;
  for (const std::uint64_t tile : tile_hashes) {
    for (unsigned shift = 0; shift < 64; shift += 8) hash = (hash ^ ((tile >> shift) & 0xFFU)) * kFnvPrime;
  }

  return hash;
}

}  // namespace aisle::grid
