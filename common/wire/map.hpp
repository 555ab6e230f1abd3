#pragma once
// Samples of idl/map.idl to and from our own types. Encoders leave `by` to the writer.
#include <cstdint>
#include <string>
#include <vector>

#include "common/grid/map_edit.hpp"
#include "common/grid/map_mirror.hpp"
#include "common/wire/checks.hpp"
#include "idl/map.hpp"

namespace aisle::wire {

aisle::MapInfo encode(const grid::MapSummary& summary);
Decoded<grid::MapSummary> decode(const aisle::MapInfo& sample);

aisle::MapTile encode(const grid::Tile& tile);
Decoded<grid::Tile> decode(const aisle::MapTile& sample);

/// Asks for these tiles again; without tiles: for `map_info`.
struct MapRequest {
  std::string requester_id;
  std::string map_id;
  std::uint64_t sequence_number{0};
  std::vector<std::uint32_t> tiles;
};
aisle::MapRequest encode(const MapRequest& request);
Decoded<MapRequest> decode(const aisle::MapRequest& sample);

aisle::MapEdit encode(const grid::MapEdit& edit);
/// Checks form and numbers; whether the edit fits the map is the map's to say.
Decoded<grid::MapEdit> decode(const aisle::MapEdit& sample);

aisle::MapEditResult encode(const grid::MapEditResult& result);
Decoded<grid::MapEditResult> decode(const aisle::MapEditResult& sample);

}  // namespace aisle::wire
