#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace aisle::fleet {

/// Asks aisle-map to write these tiles of its map again; without tiles: to write what it says of the whole map.
struct MapRequest {
  std::string requester_id;
  std::string map_id;  // empty: any
  std::uint64_t sequence_number{0};
  std::vector<std::uint32_t> tiles;  // tile_y * tiles_x + tile_x, at most 16384
};

}  // namespace aisle::fleet
