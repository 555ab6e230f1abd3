#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/fleet/zone.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::map {

/// The zones of one map, by id.
class ZoneSet {
 public:
  /// @param zones sound ones with different ids, at most fleet::kMostZones
  ZoneSet(std::string map_id, std::vector<fleet::Zone> zones, std::uint64_t revision);

  /// With the revision at which they changed last.
  const fleet::MapZones& all() const { return zones_; }

  /// Why the edit cannot be applied, in one line; empty when it can. A zone to be added is sound, has an id of its own
  /// and meets the grid's floor; one to be removed is there.
  std::string refusal_of(const fleet::ZoneEdit& edit, const grid::Geometry& floor) const;

  /// @pre refusal_of() is empty
  void apply(const fleet::ZoneEdit& edit, std::uint64_t revision);

 private:
  /// Null without such a zone.
  const fleet::Zone* find(const std::string& id) const;

  fleet::MapZones zones_;
};

/// Of all that zones say, in the order of their ids; 0 for none.
std::uint64_t hash_of(const std::vector<fleet::Zone>& zones);

}  // namespace aisle::map
