#include "common/grid/map_mirror.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::grid {
namespace {

/// Do sizes, number of tiles and hashes agree, and stay within the limits?
bool is_sound(const MapSummary& summary) {
  const Geometry& g = summary.tiling.geometry;
  const int size = summary.tiling.tile_size;
  constexpr int kMaxEdge = MapMirror::kMaxTiles * MapMirror::kMaxTileSize;
  if (size < 1 || size > MapMirror::kMaxTileSize || g.width < 1 || g.height < 1 || g.width > kMaxEdge ||
      g.height > kMaxEdge)
    return false;
  if (!std::isfinite(g.resolution_m) || g.resolution_m <= 0.0 || !geometry::is_finite(g.origin_in_map)) return false;

  const auto tiles = static_cast<std::int64_t>(summary.tiling.tiles_x()) * summary.tiling.tiles_y();
  return tiles <= MapMirror::kMaxTiles && summary.tile_hashes.size() == static_cast<std::size_t>(tiles) &&
         summary.revision > 0 && map_hash(summary.tile_hashes) == summary.hash;
}

/// Are the cells known values, and do they hash to the tile's hash?
bool is_sound(const Tile& tile) {
  return tile.tile_x >= 0 && tile.tile_y >= 0 &&
         tile.cells.size() <= std::size_t{MapMirror::kMaxTileSize} * MapMirror::kMaxTileSize &&
         std::all_of(tile.cells.begin(), tile.cells.end(),
                     [](Occupancy cell) { return cell <= Occupancy::kUnknown; }) &&
         tile_hash(tile.cells) == tile.hash;
}

}  // namespace

/// An older or equal revision of the same map says nothing new.
MapMirror::Change MapMirror::take(const MapSummary& summary) {
  if (!is_sound(summary)) return Change::kNone;

  const bool is_same_map = summary_ && summary_->map_id == summary.map_id &&
                           summary_->tiling.tile_size == summary.tiling.tile_size &&
                           summary_->tiling.geometry == summary.tiling.geometry;
  if (is_same_map && summary.revision <= summary_->revision) return Change::kNone;

  if (is_same_map) {
    summary_ = summary;
  } else {
    start_over(summary);
  }

  find_missing();
  use_waiting_tiles();

  return missing_ == 0 ? completed() : Change::kProgress;
}

/// A tile is taken by its hash and not by its revision: what the newest summary lists is wanted,
/// however old it is. A tile of a later revision waits for its summary.
MapMirror::Change MapMirror::take(const Tile& tile) {
  if (!is_sound(tile)) return Change::kNone;

  // Before the first summary every tile waits.
  if (!summary_) {
    if (waiting_.size() >= kMaxTiles) return Change::kNone;
    Tile& waiting = waiting_[{tile.tile_y, tile.tile_x}];
    if (tile.revision >= waiting.revision) waiting = tile;
    return Change::kProgress;
  }

  if (!fits(tile)) return Change::kNone;

  const int index = tile.tile_y * summary_->tiling.tiles_x() + tile.tile_x;
  if (tile.hash == summary_->tile_hashes[static_cast<std::size_t>(index)]) {
    if (is_missing_[static_cast<std::size_t>(index)] == 0) return Change::kNone;
    accept(index, tile);
    return missing_ == 0 ? completed() : Change::kProgress;
  }

  if (tile.revision <= summary_->revision) return Change::kNone;

  Tile& waiting = waiting_[{tile.tile_y, tile.tile_x}];
  if (tile.revision < waiting.revision) return Change::kNone;

  waiting = tile;
  return Change::kProgress;
}

std::vector<std::uint32_t> MapMirror::missing_tiles() const {
  std::vector<std::uint32_t> tiles;
  for (std::size_t i = 0; i < is_missing_.size(); ++i) {
    if (is_missing_[i] != 0) tiles.push_back(static_cast<std::uint32_t>(i));
  }

  return tiles;
}

void MapMirror::start_over(const MapSummary& summary) {
  summary_ = summary;
  grid_hashes_.assign(summary.tile_hashes.size(), std::nullopt);
  is_missing_.assign(summary.tile_hashes.size(), 1);
  staged_.clear();
  grid_ = OccupancyGrid{};
  revision_ = 0;
}

/// A tile is there when grid_ or staged_ holds cells with the listed hash.
void MapMirror::find_missing() {
  missing_ = 0;

  for (std::size_t i = 0; i < is_missing_.size(); ++i) {
    const std::uint64_t listed = summary_->tile_hashes[i];
    const auto staged = staged_.find(static_cast<int>(i));
    const bool is_staged = staged != staged_.end() && staged->second.hash == listed;

    if (staged != staged_.end() && !is_staged) staged_.erase(staged);
    is_missing_[i] = is_staged || grid_hashes_[i] == listed ? 0 : 1;
    missing_ += is_missing_[i];
  }
}

bool MapMirror::fits(const Tile& tile) const {
  const Tiling& tiling = summary_->tiling;
  if (tile.map_id != summary_->map_id || tile.tile_x >= tiling.tiles_x() || tile.tile_y >= tiling.tiles_y())
    return false;

  const int index = tile.tile_y * tiling.tiles_x() + tile.tile_x;
  const Cell low = tiling.low(index);
  const Cell high = tiling.high(index);

  return tile.cells.size() == static_cast<std::size_t>(high.x - low.x) * static_cast<std::size_t>(high.y - low.y);
}

void MapMirror::accept(int index, const Tile& tile) {
  staged_[index] = {tile.hash, tile.cells};
  missing_ -= is_missing_[static_cast<std::size_t>(index)];
  is_missing_[static_cast<std::size_t>(index)] = 0;
}

/// Tiles of a later revision go on waiting.
void MapMirror::use_waiting_tiles() {
  for (auto it = waiting_.begin(); it != waiting_.end();) {
    const Tile& tile = it->second;
    const bool fitting = fits(tile);
    const int index = fitting ? tile.tile_y * summary_->tiling.tiles_x() + tile.tile_x : 0;

    if (fitting && tile.hash == summary_->tile_hashes[static_cast<std::size_t>(index)]) {
      if (is_missing_[static_cast<std::size_t>(index)] != 0) accept(index, tile);
      it = waiting_.erase(it);
    } else if (!fitting || tile.revision <= summary_->revision) {
      it = waiting_.erase(it);
    } else {
      ++it;
    }
  }
}

/// Copies the staged tiles and notes the box of cells that changed.
MapMirror::Change MapMirror::completed() {
  const Tiling& tiling = summary_->tiling;
  changed_low_ = {tiling.geometry.width, tiling.geometry.height};
  changed_high_ = {-1, -1};

  // The first map: everything counts as changed.
  if (revision_ == 0) {
    grid_ = OccupancyGrid(tiling.geometry, Occupancy::kUnknown);
    changed_low_ = {0, 0};
    changed_high_ = {tiling.geometry.width - 1, tiling.geometry.height - 1};
  }

  for (const auto& [index, staged] : staged_) {
    grid_hashes_[static_cast<std::size_t>(index)] = staged.hash;

    const Cell low = tiling.low(index);
    const Cell high = tiling.high(index);
    std::size_t i = 0;

    for (int y = low.y; y < high.y; ++y) {
      for (int x = low.x; x < high.x; ++x, ++i) {
        if (grid_.at({x, y}) == staged.cells[i]) continue;
        grid_.set({x, y}, staged.cells[i]);
        changed_low_ = {std::min(changed_low_.x, x), std::min(changed_low_.y, y)};
        changed_high_ = {std::max(changed_high_.x, x), std::max(changed_high_.y, y)};
      }
    }
  }

  staged_.clear();
  revision_ = summary_->revision;

  return Change::kComplete;
}

}  // namespace aisle::grid
