#include "services/map/core/site_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <set>
#include <utility>

namespace aisle::map {
namespace {

using fleet::MapEdit;
using grid::Cell;
using grid::Occupancy;

/// The state of a covered cell once the edit is applied.
Occupancy after(MapEdit::Action action) {
  return action == MapEdit::Action::kBlock ? Occupancy::kOccupied : Occupancy::kFree;
}

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.6g", value);
  return buffer;
}

/// Wrong number of points, or numbers that are none; before anything is computed from them.
std::string refusal_of_form(const MapEdit& edit) {
  const std::size_t points = edit.points_in_map.size();
  if (edit.edit_id.empty()) return "edit_id is empty";

  for (const geometry::Point2 p : edit.points_in_map) {
    if (!geometry::is_finite(p)) return "a point is not finite";
  }

  switch (edit.shape) {
    case MapEdit::Shape::kRectangle:
      return points == 2 ? "" : "a rectangle has 2 corners, this has " + std::to_string(points);
    case MapEdit::Shape::kPolygon:
      return points >= 3 && points <= 64 ? "" : "a polygon has 3 to 64 corners, this has " + std::to_string(points);
    case MapEdit::Shape::kDisc:
      if (points != 1) return "a disc has 1 centre, this has " + std::to_string(points);
      return std::isfinite(edit.radius_m) && edit.radius_m > 0.0
                 ? ""
                 : "radius_m = " + text(edit.radius_m) + " is not more than 0";
  }

  return "unknown shape";
}

/// The area of the grid in map, for messages.
std::string extent(const grid::Geometry& g) {
  return "x " + text(g.origin_in_map.x) + " to " + text(g.origin_in_map.x + g.width * g.resolution_m) + " m, y " +
         text(g.origin_in_map.y) + " to " + text(g.origin_in_map.y + g.height * g.resolution_m) + " m";
}

}  // namespace

SiteMap::SiteMap(std::string map_id, grid::OccupancyGrid grid, std::uint64_t revision) : grid_(std::move(grid)) {
  summary_.map_id = std::move(map_id);
  summary_.revision = revision;
  summary_.tiling = {64, grid_.geometry()};

  for (int i = 0; i < tiles(); ++i)
    summary_.tile_hashes.push_back(grid::tile_hash(grid::tile_cells(grid_, summary_.tiling, i)));

  summary_.hash = grid::map_hash(summary_.tile_hashes);
  tile_revisions_.assign(summary_.tile_hashes.size(), revision);
}

grid::Tile SiteMap::tile(int index) const {
  const grid::Tiling& tiling = summary_.tiling;
  const auto i = static_cast<std::size_t>(index);
  return {summary_.map_id,    index % tiling.tiles_x(), index / tiling.tiles_x(),
          tile_revisions_[i], summary_.tile_hashes[i],  grid::tile_cells(grid_, tiling, index)};
}

std::uint32_t SiteMap::count_changes(const std::vector<CellRun>& runs, MapEdit::Action action) const {
  std::uint32_t changes = 0;
  for (const CellRun& run : runs) {
    for (int x = run.x_begin; x < run.x_end; ++x) changes += grid_.at({x, run.y}) != after(action) ? 1U : 0U;
  }

  return changes;
}

std::vector<int> SiteMap::apply(const std::vector<CellRun>& runs, MapEdit::Action action) {
  // Set the cells and note the tiles they are in; cells that have the state already touch no tile.
  const int size = summary_.tiling.tile_size;
  std::set<int> changed;
  for (const CellRun& run : runs) {
    for (int x = run.x_begin; x < run.x_end; ++x) {
      const Cell cell{x, run.y};
      if (grid_.at(cell) == after(action)) continue;

      grid_.set(cell, after(action));
      changed.insert(run.y / size * summary_.tiling.tiles_x() + x / size);
    }
  }

  ++summary_.revision;

  // Only hashes of changed tiles are computed again; the map's hash is made of all tiles' hashes.
  for (const int tile : changed) {
    summary_.tile_hashes[static_cast<std::size_t>(tile)] =
        grid::tile_hash(grid::tile_cells(grid_, summary_.tiling, tile));
    tile_revisions_[static_cast<std::size_t>(tile)] = summary_.revision;
  }

  summary_.hash = grid::map_hash(summary_.tile_hashes);
  return {changed.begin(), changed.end()};
}

std::string refusal_of(const MapEdit& edit, const SiteMap& map, const EditLimits& limits) {
  if (edit.map_id != map.map_id()) return "map '" + edit.map_id + "' is not served here, '" + map.map_id() + "' is";
  std::string reason = refusal_of_form(edit);

  if (!reason.empty()) return reason;

  // Only now, as the shape is well formed, is it laid over the grid.
  std::int64_t cells = 0;
  for (const CellRun& run : rasterise(edit, map.grid().geometry())) cells += run.x_end - run.x_begin;
  if (cells == 0) return "covers no cell: it has no area or lies outside the map, " + extent(map.grid().geometry());

  if (cells > limits.max_cells) {
    return "covers " + std::to_string(cells) + " cells, one edit may cover " + std::to_string(limits.max_cells) +
           ": cut it into smaller ones";
  }

  return {};
}

}  // namespace aisle::map
