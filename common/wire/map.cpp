#include "common/wire/map.hpp"

#include <algorithm>
#include <utility>

#include "common/wire/geometry.hpp"

namespace aisle::wire {
namespace {

constexpr std::size_t kMaxTiles = 16384;
constexpr std::size_t kMaxCells = 16384;
constexpr double kMaxEdgeCells = 2097152.0;
constexpr std::size_t kMaxDetail = 256;

std::vector<std::uint8_t> bytes(const std::vector<grid::Occupancy>& cells) {
  std::vector<std::uint8_t> out(cells.size());
  std::transform(cells.begin(), cells.end(), out.begin(),
                 [](grid::Occupancy cell) { return static_cast<std::uint8_t>(cell); });
  return out;
}

grid::Tiling decode_tiling(const aisle::MapInfo& sample, Checks& checks) {
  checks.within("width_cells", sample.width_cells(), 1.0, kMaxEdgeCells)
      .within("height_cells", sample.height_cells(), 1.0, kMaxEdgeCells)
      .within("resolution_m", sample.resolution_m(), 1e-4, 1e3)
      .within("tile_size_cells", sample.tile_size_cells(), 1.0, grid::MapMirror::kMaxTileSize);
  const geometry::Pose2 origin = decode(sample.origin_in_map(), checks, "origin_in_map");
  checks.holds(origin.yaw == 0.0, "origin_in_map.yaw_rad is not 0");
  if (!checks.ok()) return {};
  grid::Tiling tiling;
  tiling.tile_size = static_cast<int>(sample.tile_size_cells());
  tiling.geometry = {static_cast<int>(sample.width_cells()), static_cast<int>(sample.height_cells()),
                     sample.resolution_m(), origin.position()};
  return tiling;
}

}  // namespace

aisle::MapInfo encode(const grid::MapSummary& summary) {
  const grid::Geometry& g = summary.tiling.geometry;
  aisle::MapInfo sample;
  sample.map_id(summary.map_id);
  sample.revision(summary.revision);
  sample.width_cells(static_cast<std::uint32_t>(g.width));
  sample.height_cells(static_cast<std::uint32_t>(g.height));
  sample.resolution_m(g.resolution_m);
  sample.origin_in_map(encode(geometry::Pose2{g.origin_in_map.x, g.origin_in_map.y, 0.0}));
  sample.tile_size_cells(static_cast<std::uint32_t>(summary.tiling.tile_size));
  sample.hash(summary.hash);
  sample.tile_hashes(summary.tile_hashes);
  return sample;
}

Decoded<grid::MapSummary> decode(const aisle::MapInfo& sample) {
  Checks checks;
  grid::MapSummary summary;
  summary.map_id = sample.map_id().to_string();
  summary.revision = sample.revision();
  summary.hash = sample.hash();
  checks.id("map_id", summary.map_id).holds(summary.revision > 0, "revision counts from 1");
  summary.tiling = decode_tiling(sample, checks);
  if (!checks.ok()) return Decoded<grid::MapSummary>::refused(checks.reason());
  const auto tiles =
      static_cast<std::size_t>(summary.tiling.tiles_x()) * static_cast<std::size_t>(summary.tiling.tiles_y());
  checks.count("tile_hashes", sample.tile_hashes().size(), tiles, std::min(tiles, kMaxTiles));
  if (!checks.ok()) return Decoded<grid::MapSummary>::refused(checks.reason());
  summary.tile_hashes = sample.tile_hashes();
  if (grid::map_hash(summary.tile_hashes) != summary.hash) {
    return Decoded<grid::MapSummary>::refused("hash does not belong to tile_hashes");
  }
  return summary;
}

aisle::MapTile encode(const grid::Tile& tile) {
  aisle::MapTile sample;
  sample.map_id(tile.map_id);
  sample.tile_x(static_cast<std::uint32_t>(tile.tile_x));
  sample.tile_y(static_cast<std::uint32_t>(tile.tile_y));
  sample.revision(tile.revision);
  sample.hash(tile.hash);
  sample.cells(bytes(tile.cells));
  return sample;
}

Decoded<grid::Tile> decode(const aisle::MapTile& sample) {
  Checks checks;
  grid::Tile tile;
  tile.map_id = sample.map_id().to_string();
  checks.id("map_id", tile.map_id)
      .within("tile_x", sample.tile_x(), 0.0, kMaxTiles - 1.0)
      .within("tile_y", sample.tile_y(), 0.0, kMaxTiles - 1.0)
      .count("cells", sample.cells().size(), 1, kMaxCells);
  if (!checks.ok()) return Decoded<grid::Tile>::refused(checks.reason());
  tile.tile_x = static_cast<int>(sample.tile_x());
  tile.tile_y = static_cast<int>(sample.tile_y());
  tile.revision = sample.revision();
  tile.hash = sample.hash();
  tile.cells.resize(sample.cells().size());
  for (std::size_t i = 0; i < tile.cells.size(); ++i) {
    if (sample.cells()[i] > static_cast<std::uint8_t>(grid::Occupancy::kUnknown)) {
      return Decoded<grid::Tile>::refused("cells[" + std::to_string(i) + "] = " + std::to_string(sample.cells()[i]) +
                                          " is not 0, 1 or 2");
    }
    tile.cells[i] = static_cast<grid::Occupancy>(sample.cells()[i]);
  }
  if (grid::tile_hash(tile.cells) != tile.hash) return Decoded<grid::Tile>::refused("hash does not belong to cells");
  return tile;
}

aisle::MapRequest encode(const MapRequest& request) {
  aisle::MapRequest sample;
  sample.requester_id(request.requester_id);
  sample.map_id(request.map_id);
  sample.sequence_number(request.sequence_number);
  sample.tiles(request.tiles);
  return sample;
}

Decoded<MapRequest> decode(const aisle::MapRequest& sample) {
  Checks checks;
  MapRequest request{sample.requester_id().to_string(), sample.map_id().to_string(), sample.sequence_number(), {}};
  checks.id("requester_id", request.requester_id).count("tiles", sample.tiles().size(), 0, kMaxTiles);
  if (!checks.ok()) return Decoded<MapRequest>::refused(checks.reason());
  request.tiles = sample.tiles();
  return request;
}

aisle::MapEdit encode(const grid::MapEdit& edit) {
  aisle::MapEdit sample;
  sample.edit_id(edit.edit_id);
  sample.map_id(edit.map_id);
  sample.action(static_cast<aisle::EditAction>(edit.action));
  sample.shape(static_cast<aisle::EditShape>(edit.shape));
  for (const geometry::Point2 point : edit.points_in_map) sample.points().push_back(encode(point));
  sample.radius_m(edit.radius_m);
  return sample;
}

Decoded<grid::MapEdit> decode(const aisle::MapEdit& sample) {
  Checks checks;
  grid::MapEdit edit;
  edit.edit_id = sample.edit_id().to_string();
  edit.map_id = sample.map_id().to_string();
  checks.id("edit_id", edit.edit_id)
      .id("map_id", edit.map_id)
      .known("action", sample.action(), aisle::EditAction::EDIT_UNBLOCK)
      .known("shape", sample.shape(), aisle::EditShape::SHAPE_DISC)
      .count("points", sample.points().size(), 1, 64)
      .within("radius_m", sample.radius_m(), -kFarthestM, kFarthestM);
  if (!checks.ok()) return Decoded<grid::MapEdit>::refused(checks.reason());
  edit.action = static_cast<grid::MapEdit::Action>(sample.action());
  edit.shape = static_cast<grid::MapEdit::Shape>(sample.shape());
  for (const aisle::Point& point : sample.points()) edit.points_in_map.push_back(decode(point, checks, "points"));
  edit.radius_m = sample.radius_m();
  if (!checks.ok()) return Decoded<grid::MapEdit>::refused(checks.reason());
  return edit;
}

aisle::MapEditResult encode(const grid::MapEditResult& result) {
  aisle::MapEditResult sample;
  sample.edit_id(result.edit_id);
  sample.map_id(result.map_id);
  sample.outcome(static_cast<aisle::EditOutcome>(result.outcome));
  sample.detail(result.detail.substr(0, kMaxDetail));
  sample.revision(result.revision);
  sample.changed_cells(result.changed_cells);
  return sample;
}

Decoded<grid::MapEditResult> decode(const aisle::MapEditResult& sample) {
  Checks checks;
  grid::MapEditResult result;
  result.edit_id = sample.edit_id().to_string();
  result.map_id = sample.map_id().to_string();
  checks.id("edit_id", result.edit_id).known("outcome", sample.outcome(), aisle::EditOutcome::EDIT_REFUSED);
  if (!checks.ok()) return Decoded<grid::MapEditResult>::refused(checks.reason());
  result.outcome = static_cast<grid::MapEditResult::Outcome>(sample.outcome());
  result.detail = sample.detail().to_string();
  result.revision = sample.revision();
  result.changed_cells = sample.changed_cells();
  return result;
}

}  // namespace aisle::wire
