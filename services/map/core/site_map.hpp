#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/grid/map_mirror.hpp"
#include "services/map/core/rasterise.hpp"

namespace aisle::map {

/// The map of a site: its cells, its revision (raised by each edit) and the hashes by which mirrors compare their copy,
/// one of each tile of 64 x 64 cells and one of the whole. Keeps the effect of edits, not the edits.
class SiteMap {
 public:
  /// @pre the grid fits into 16384 tiles of 64 x 64, as every map file that was read does; revision > 0
  SiteMap(std::string map_id, grid::OccupancyGrid grid, std::uint64_t revision = 1);

  /// Identity, revision and content, as `map_info` says them.
  const std::string& map_id() const { return summary_.map_id; }
  std::uint64_t revision() const { return summary_.revision; }

  const grid::OccupancyGrid& grid() const { return grid_; }
  const grid::MapSummary& summary() const { return summary_; }
  int tiles() const { return summary_.tiling.count(); }

  /// A copy of one tile, as it is sent. Tiles are numbered row by row from the lower left corner.
  /// @pre 0 <= index < tiles()
  grid::Tile tile(int index) const;

  /// The number of cells that apply() would change. @pre runs lie within the grid and do not overlap
  std::uint32_t count_changes(const std::vector<CellRun>& runs, fleet::MapEdit::Action action) const;

  /// Blocks the cells, or makes them free (walls of the map file and unknown cells as well); raises the revision by
  /// one, also when nothing changes. Returns the tiles that changed.
  std::vector<int> apply(const std::vector<CellRun>& runs, fleet::MapEdit::Action action);

 private:
  grid::OccupancyGrid grid_;
  grid::MapSummary summary_;

  /// The revision at which each tile changed last.
  std::vector<std::uint64_t> tile_revisions_;
};

/// What one edit may be; the rest of its form is the decoder's to check.
struct EditLimits {
  int max_cells{1000000};
};

/// Why the edit cannot be applied to this map, in one line that names value and limit; empty when it can.
std::string refusal_of(const fleet::MapEdit& edit, const SiteMap& map, const EditLimits& limits);

}  // namespace aisle::map
