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

/// 0 free, 1 occupied, 2 unknown, as in the IDL.
std::vector<std::uint8_t> bytes(const std::vector<grid::Occupancy>& cells) {
  std::vector<std::uint8_t> out(cells.size());
  std::transform(cells.begin(), cells.end(), out.begin(),
                 [](grid::Occupancy cell) { return static_cast<std::uint8_t>(cell); });
  return out;
}

/// Enumerators: see planning.cpp.
aisle::EditAction to_wire(fleet::MapEdit::Action action) {
  switch (action) {
    case fleet::MapEdit::Action::kBlock:
      return EditAction::EDIT_BLOCK;
    case fleet::MapEdit::Action::kUnblock:
      return EditAction::EDIT_UNBLOCK;
  }

  return {};
}

std::optional<fleet::MapEdit::Action> from_wire(aisle::EditAction action) {
  switch (action) {
    case EditAction::EDIT_BLOCK:
      return fleet::MapEdit::Action::kBlock;
    case EditAction::EDIT_UNBLOCK:
      return fleet::MapEdit::Action::kUnblock;
  }

  return std::nullopt;
}

aisle::EditShape to_wire(fleet::MapEdit::Shape shape) {
  switch (shape) {
    case fleet::MapEdit::Shape::kRectangle:
      return EditShape::SHAPE_RECTANGLE;
    case fleet::MapEdit::Shape::kPolygon:
      return EditShape::SHAPE_POLYGON;
    case fleet::MapEdit::Shape::kDisc:
      return EditShape::SHAPE_DISC;
  }

  return {};
}

std::optional<fleet::MapEdit::Shape> from_wire(aisle::EditShape shape) {
  switch (shape) {
    case EditShape::SHAPE_RECTANGLE:
      return fleet::MapEdit::Shape::kRectangle;
    case EditShape::SHAPE_POLYGON:
      return fleet::MapEdit::Shape::kPolygon;
    case EditShape::SHAPE_DISC:
      return fleet::MapEdit::Shape::kDisc;
  }

  return std::nullopt;
}

aisle::EditOutcome to_wire(fleet::MapEditResult::Outcome outcome) {
  switch (outcome) {
    case fleet::MapEditResult::Outcome::kApplied:
      return EditOutcome::EDIT_APPLIED;
    case fleet::MapEditResult::Outcome::kAlreadyApplied:
      return EditOutcome::EDIT_ALREADY_APPLIED;
    case fleet::MapEditResult::Outcome::kRefused:
      return EditOutcome::EDIT_REFUSED;
  }

  return {};
}

std::optional<fleet::MapEditResult::Outcome> from_wire(aisle::EditOutcome outcome) {
  switch (outcome) {
    case EditOutcome::EDIT_APPLIED:
      return fleet::MapEditResult::Outcome::kApplied;
    case EditOutcome::EDIT_ALREADY_APPLIED:
      return fleet::MapEditResult::Outcome::kAlreadyApplied;
    case EditOutcome::EDIT_REFUSED:
      return fleet::MapEditResult::Outcome::kRefused;
  }

  return std::nullopt;
}

aisle::ZoneKind to_wire(fleet::Zone::Kind kind) {
  switch (kind) {
    case fleet::Zone::Kind::kKeepOut:
      return ZoneKind::ZONE_KEEP_OUT;
    case fleet::Zone::Kind::kSpeed:
      return ZoneKind::ZONE_SPEED;
    case fleet::Zone::Kind::kOneWay:
      return ZoneKind::ZONE_ONE_WAY;
    case fleet::Zone::Kind::kNoStopping:
      return ZoneKind::ZONE_NO_STOPPING;
    case fleet::Zone::Kind::kOneVehicle:
      return ZoneKind::ZONE_ONE_VEHICLE;
    case fleet::Zone::Kind::kParking:
      return ZoneKind::ZONE_PARKING;
  }

  return {};
}

std::optional<fleet::Zone::Kind> from_wire(aisle::ZoneKind kind) {
  switch (kind) {
    case ZoneKind::ZONE_KEEP_OUT:
      return fleet::Zone::Kind::kKeepOut;
    case ZoneKind::ZONE_SPEED:
      return fleet::Zone::Kind::kSpeed;
    case ZoneKind::ZONE_ONE_WAY:
      return fleet::Zone::Kind::kOneWay;
    case ZoneKind::ZONE_NO_STOPPING:
      return fleet::Zone::Kind::kNoStopping;
    case ZoneKind::ZONE_ONE_VEHICLE:
      return fleet::Zone::Kind::kOneVehicle;
    case ZoneKind::ZONE_PARKING:
      return fleet::Zone::Kind::kParking;
  }

  return std::nullopt;
}

aisle::ZoneAction to_wire(fleet::ZoneEdit::Action action) {
  switch (action) {
    case fleet::ZoneEdit::Action::kAdd:
      return ZoneAction::ZONE_ADD;
    case fleet::ZoneEdit::Action::kRemove:
      return ZoneAction::ZONE_REMOVE;
  }

  return {};
}

std::optional<fleet::ZoneEdit::Action> from_wire(aisle::ZoneAction action) {
  switch (action) {
    case ZoneAction::ZONE_ADD:
      return fleet::ZoneEdit::Action::kAdd;
    case ZoneAction::ZONE_REMOVE:
      return fleet::ZoneEdit::Action::kRemove;
  }

  return std::nullopt;
}

aisle::MapZone encode_zone(const fleet::Zone& zone) {
  aisle::MapZone sample;
  sample.zone_id(zone.id);
  sample.kind(to_wire(zone.kind));

  sample.shape(to_wire(zone.shape));
  for (const geometry::Point2 point : zone.points_in_map) sample.points().push_back(encode(point));
  sample.radius_m(zone.radius_m);

  sample.max_speed_mps(zone.max_speed_mps);
  sample.direction_rad(zone.direction_rad);

  return sample;
}

/// The value itself says what is no zone; its reasons name the fields as the wire does.
fleet::Zone decode_zone(const aisle::MapZone& sample, Checks& checks) {
  fleet::Zone zone;
  zone.id = sample.zone_id().to_string();
  zone.kind = checks.known("kind", sample.kind(), from_wire(sample.kind()));
  zone.shape = checks.known("shape", sample.shape(), from_wire(sample.shape()));

  checks.count("points", sample.points().size(), 1, 64);
  if (!checks.ok()) return zone;

  for (const aisle::Point& point : sample.points()) zone.points_in_map.push_back({point.x_m(), point.y_m()});
  zone.radius_m = sample.radius_m();
  zone.max_speed_mps = sample.max_speed_mps();
  zone.direction_rad = sample.direction_rad();

  const std::string reason = fleet::refusal_of(zone);
  checks.holds(reason.empty(), reason.c_str());

  return zone;
}

/// Checks the sizes before anything is computed from them.
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

/// The sizes first: they say how many hashes there must be.
Decoded<grid::MapSummary> decode(const aisle::MapInfo& sample) {
  Checks checks;
  grid::MapSummary summary;

  summary.map_id = sample.map_id().to_string();
  summary.revision = sample.revision();
  summary.hash = sample.hash();
  checks.id("map_id", summary.map_id).holds(summary.revision > 0, "revision counts from 1");
  summary.tiling = decode_tiling(sample, checks);

  if (!checks.ok()) return Decoded<grid::MapSummary>::refused(checks.reason());

  // As many hashes as tiles, and no more than a map may have.
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

/// Every cell and the hash are checked, so that a mirror never holds a cell of another kind.
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

aisle::MapRequest encode(const fleet::MapRequest& request) {
  aisle::MapRequest sample;
  sample.requester_id(request.requester_id);
  sample.map_id(request.map_id);
  sample.sequence_number(request.sequence_number);
  sample.tiles(request.tiles);

  return sample;
}

Decoded<fleet::MapRequest> decode(const aisle::MapRequest& sample) {
  Checks checks;
  fleet::MapRequest request{
      sample.requester_id().to_string(), sample.map_id().to_string(), sample.sequence_number(), {}};

  checks.id("requester_id", request.requester_id)
      .optional_id("map_id", request.map_id)
      .count("tiles", sample.tiles().size(), 0, kMaxTiles);

  if (!checks.ok()) return Decoded<fleet::MapRequest>::refused(checks.reason());

  request.tiles = sample.tiles();
  return request;
}

aisle::MapEdit encode(const fleet::MapEdit& edit) {
  aisle::MapEdit sample;
  sample.edit_id(edit.edit_id);
  sample.map_id(edit.map_id);

  sample.action(to_wire(edit.action));
  sample.shape(to_wire(edit.shape));
  for (const geometry::Point2 point : edit.points_in_map) sample.points().push_back(encode(point));
  sample.radius_m(edit.radius_m);

  return sample;
}

Decoded<fleet::MapEdit> decode(const aisle::MapEdit& sample) {
  Checks checks;
  fleet::MapEdit edit;

  edit.edit_id = sample.edit_id().to_string();
  edit.map_id = sample.map_id().to_string();

  edit.action = checks.known("action", sample.action(), from_wire(sample.action()));
  edit.shape = checks.known("shape", sample.shape(), from_wire(sample.shape()));
  edit.radius_m = sample.radius_m();

  checks.id("edit_id", edit.edit_id)
      .id("map_id", edit.map_id)
      .count("points", sample.points().size(), 1, 64)
      .within("radius_m", edit.radius_m, -kFarthestM, kFarthestM);

  for (const aisle::Point& point : sample.points()) edit.points_in_map.push_back(decode(point, checks, "points"));

  return checks.decoded(std::move(edit));
}

aisle::MapEditResult encode(const fleet::MapEditResult& result) {
  aisle::MapEditResult sample;
  sample.edit_id(result.edit_id);
  sample.map_id(result.map_id);

  sample.outcome(to_wire(result.outcome));
  sample.detail(result.detail.substr(0, kMaxDetail));

  sample.revision(result.revision);
  sample.changed_cells(result.changed_cells);

  return sample;
}

Decoded<fleet::MapEditResult> decode(const aisle::MapEditResult& sample) {
  Checks checks;
  fleet::MapEditResult result;

  result.edit_id = sample.edit_id().to_string();
  result.map_id = sample.map_id().to_string();

  result.outcome = checks.known("outcome", sample.outcome(), from_wire(sample.outcome()));
  result.detail = sample.detail().to_string();
  result.revision = sample.revision();
  result.changed_cells = sample.changed_cells();
  checks.id("edit_id", result.edit_id).optional_id("map_id", result.map_id);

  return checks.decoded(std::move(result));
}

aisle::ZoneEdit encode(const fleet::ZoneEdit& edit) {
  aisle::ZoneEdit sample;
  sample.edit_id(edit.edit_id);
  sample.map_id(edit.map_id);

  sample.action(to_wire(edit.action));
  sample.zone(encode_zone(edit.zone));

  return sample;
}

Decoded<fleet::ZoneEdit> decode(const aisle::ZoneEdit& sample) {
  Checks checks;
  fleet::ZoneEdit edit;

  edit.edit_id = sample.edit_id().to_string();
  edit.map_id = sample.map_id().to_string();
  edit.action = checks.known("action", sample.action(), from_wire(sample.action()));
  checks.id("edit_id", edit.edit_id).id("map_id", edit.map_id);

  if (edit.action == fleet::ZoneEdit::Action::kAdd) {
    edit.zone = decode_zone(sample.zone(), checks);
  } else {
    edit.zone.id = sample.zone().zone_id().to_string();
    checks.id("zone_id", edit.zone.id);
  }

  return checks.decoded(std::move(edit));
}

aisle::MapZones encode(const fleet::MapZones& zones) {
  aisle::MapZones sample;
  sample.map_id(zones.map_id);
  sample.revision(zones.revision);

  for (const fleet::Zone& zone : zones.zones) {
    if (sample.zones().size() == fleet::kMostZones) break;
    sample.zones().push_back(encode_zone(zone));
  }

  return sample;
}

Decoded<fleet::MapZones> decode(const aisle::MapZones& sample) {
  Checks checks;
  fleet::MapZones zones{sample.map_id().to_string(), sample.revision(), {}};

  checks.id("map_id", zones.map_id)
      .holds(zones.revision > 0, "revision counts from 1")
      .count("zones", sample.zones().size(), 0, fleet::kMostZones);

  for (const aisle::MapZone& zone : sample.zones()) {
    if (!checks.ok()) break;

    fleet::Zone next = decode_zone(zone, checks);
    checks.holds(zones.zones.empty() || zones.zones.back().id < next.id, "zones: zone_id does not ascend");
    zones.zones.push_back(std::move(next));
  }

  return checks.decoded(std::move(zones));
}

}  // namespace aisle::wire
