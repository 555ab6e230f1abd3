#pragma once

// Samples of idl/map.idl to and from values of common/fleet and common/grid. Encoders leave `by` to the writer.

#include "common/fleet/map_edit.hpp"
#include "common/fleet/map_request.hpp"
#include "common/fleet/zone.hpp"
#include "common/grid/map_mirror.hpp"
#include "common/wire/checks.hpp"
#include "idl/map.hpp"

namespace aisle::wire {

aisle::MapInfo encode(const grid::MapSummary& summary);

/// Refused when the sizes contradict each other or the hash is not that of the tile hashes.
Decoded<grid::MapSummary> decode(const aisle::MapInfo& sample);

aisle::MapTile encode(const grid::Tile& tile);

/// Refused when a cell is not 0, 1 or 2, or the hash is not that of the cells.
Decoded<grid::Tile> decode(const aisle::MapTile& sample);

aisle::MapRequest encode(const fleet::MapRequest& request);

/// At most 16384 tiles.
Decoded<fleet::MapRequest> decode(const aisle::MapRequest& sample);

aisle::MapEdit encode(const fleet::MapEdit& edit);

/// Checks form and numbers only: aisle-map decides whether the edit fits the map.
Decoded<fleet::MapEdit> decode(const aisle::MapEdit& sample);

aisle::MapEditResult encode(const fleet::MapEditResult& result);
Decoded<fleet::MapEditResult> decode(const aisle::MapEditResult& sample);

aisle::ZoneEdit encode(const fleet::ZoneEdit& edit);

/// Refused when the zone to be added is none (fleet::refusal_of). Of a zone to be removed only the id is read.
Decoded<fleet::ZoneEdit> decode(const aisle::ZoneEdit& sample);

/// Of more than 256 zones, the first are written.
aisle::MapZones encode(const fleet::MapZones& zones);

/// Refused when one of them is no zone, or their ids do not ascend.
Decoded<fleet::MapZones> decode(const aisle::MapZones& sample);

}  // namespace aisle::wire
