#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "common/fleet/coverage.hpp"
#include "common/time/stamp.hpp"

namespace aisle::global_planner {

/// When each place of the floor was seen last by a lidar of the fleet, from the tracker's coverage.
class SeenFloor {
 public:
  /// `arrived`: what its ages count from.
  void set(const fleet::CoverageTile& tile, time::Stamp arrived) {
    tiles_[{tile.tile_x, tile.tile_y}] = {tile, arrived};
  }

  /// The earliest moment at which it may have been seen last; none: never, long ago, or not known.
  std::optional<time::Stamp> seen(geometry::Point2 place_in_map) const {
    for (const auto& [key, entry] : tiles_) {
      const fleet::CoverageTile& tile = entry.first;
      const geometry::Point2 from_low = place_in_map - tile.low_in_map;
      const int x = static_cast<int>(std::floor(from_low.x / tile.cell_m));
      const int y = static_cast<int>(std::floor(from_low.y / tile.cell_m));
      if (x < 0 || y < 0 || x >= tile.width_cells || y >= tile.height_cells) continue;

      const std::uint8_t age = tile.ages[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width_cells) +
                                         static_cast<std::size_t>(x)];
      if (age >= fleet::kSeenLongAgo) return std::nullopt;
      return entry.second - time::from_seconds(age * tile.age_step_s);
    }

    return std::nullopt;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<fleet::CoverageTile, time::Stamp>> tiles_;
};

}  // namespace aisle::global_planner
