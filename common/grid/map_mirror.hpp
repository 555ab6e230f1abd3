#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/tiles.hpp"

namespace aisle::grid {

/// What aisle-map says of the whole map (decoded `map_info`).
struct MapSummary {
  std::string map_id;
  std::uint64_t revision{0};
  std::uint64_t hash{0};
  Tiling tiling;
  std::vector<std::uint64_t> tile_hashes;
};

/// One decoded `map_tile`.
struct Tile {
  std::string map_id;
  int tile_x{0};
  int tile_y{0};
  std::uint64_t revision{0};
  std::uint64_t hash{0};
  std::vector<Occupancy> cells;
};

/// A copy of the site's map that knows when it is complete: when the cells of every tile hash to what the newest summary lists.
/// Tiles and summaries may come in any order and more than once; older revisions of the same map are ignored.
class MapMirror {
 public:
  /// What a sample did.
  enum class Change { kNone, kProgress, kComplete };

  /// A summary of another map id, size or place starts over. kComplete: the mirror became complete at a new revision.
  Change take(const MapSummary& summary);
  /// A tile whose cells do not hash to its own hash is ignored.
  Change take(const Tile& tile);

  bool is_complete() const;
  const std::optional<MapSummary>& summary() const;
  /// Of the newest *complete* map; 0 before the first.
  std::uint64_t revision() const;
  /// The newest complete map; keeps its cells while newer tiles still come in. @pre revision() > 0
  const OccupancyGrid& grid() const;
  /// Cells that the last kComplete changed, both included: feed it to ClearanceField::update. Whole grid at first.
  Cell changed_low() const;
  Cell changed_high() const;
  /// Tiles still missing or old, to ask aisle-map for.
  std::vector<std::uint32_t> missing_tiles() const;
};

}  // namespace aisle::grid
