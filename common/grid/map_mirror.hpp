#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/grid/tiles.hpp"

namespace aisle::grid {

/// What aisle-map says of the whole map (a decoded `map_info`).
struct MapSummary {
  std::string map_id;
  std::uint64_t revision{0};
  std::uint64_t hash{0};
  Tiling tiling;
  std::vector<std::uint64_t> tile_hashes;
};

/// A square piece of the map (a decoded `map_tile`): cells row by row from the bottom, numbered as in
/// Tiling.
struct Tile {
  std::string map_id;
  int tile_x{0};
  int tile_y{0};
  std::uint64_t revision{0};
  std::uint64_t hash{0};
  std::vector<Occupancy> cells;
};

/// A copy of the site's map that knows when it is complete: when the cells of every tile hash to what the newest
/// summary lists. Tiles and summaries may come in any order and more than once; older revisions of the same map are
/// ignored.
///
///   empty --summary--> incomplete --last tile--> complete --newer summary--> incomplete (grid() still the last
///   complete one) ...
///
/// Tiles that come before the summary that lists them wait, at most kMaxTiles of them; they leave a complete mirror
/// complete.
class MapMirror {
 public:
  static constexpr int kMaxTiles = 16384;
  static constexpr int kMaxTileSize = 128;

  /// What a sample did to the mirror: nothing; it brought news, but tiles are missing; a new revision
  /// is whole.
  enum class Change { kNone, kProgress, kComplete };

  /// A summary of another map id, size or place starts over. kComplete: the mirror became complete at a new revision.
  /// Ignored when it contradicts itself (number of tiles, hash, sizes beyond the limits above, numbers that are not
  /// finite).
  Change take(const MapSummary& summary);

  /// A tile whose cells do not hash to its own hash, or are not 0, 1 or 2, is ignored.
  Change take(const Tile& tile);

  /// Complete at the newest summary.
  bool is_complete() const { return summary_.has_value() && missing_ == 0; }

  /// The newest summary heard, none at first.
  const std::optional<MapSummary>& summary() const { return summary_; }

  /// Of the newest *complete* map; 0 before the first.
  std::uint64_t revision() const { return revision_; }

  /// The newest complete map; keeps its cells while newer tiles still come in. @pre revision() > 0
  const OccupancyGrid& grid() const { return grid_; }

  /// Cells that the last kComplete changed, both included: feed it to ClearanceField::update. Whole grid at first;
  /// `changed_high` below `changed_low` when no cell changed.
  Cell changed_low() const { return changed_low_; }

  /// See changed_low().
  Cell changed_high() const { return changed_high_; }

  /// Tiles still missing or old, to ask aisle-map for.
  std::vector<std::uint32_t> missing_tiles() const;

 private:
  /// Cells of a tile that came and is waiting for the others of its revision.
  struct Staged {
    std::uint64_t hash;
    std::vector<Occupancy> cells;
  };

  /// Another map: forgets all cells.
  void start_over(const MapSummary& summary);

  /// Has the tile the size that the summary gives to its place?
  bool fits(const Tile& tile) const;

  /// Stages a tile that is as the summary lists it.
  void accept(int index, const Tile& tile);

  /// Which tiles neither grid_ nor staged_ holds as the newest summary lists them.
  void find_missing();

  /// Waiting tiles that the newest summary lists are accepted, those that it has overtaken dropped.
  void use_waiting_tiles();

  /// kComplete when no tile is missing any more: staged tiles go into grid_.
  Change completed();

  std::optional<MapSummary> summary_;
  std::vector<std::optional<std::uint64_t>> grid_hashes_;  // of the tiles in grid_; none before the first complete map
  std::vector<std::uint8_t> is_missing_;
  int missing_{0};
  std::map<std::pair<int, int>, Tile> waiting_;  // by (tile_y, tile_x)
  std::map<int, Staged> staged_;                 // as the summary lists them, not yet in grid_
  OccupancyGrid grid_;
  std::uint64_t revision_{0};
  Cell changed_low_{0, 0};
  Cell changed_high_{-1, -1};
};

}  // namespace aisle::grid
