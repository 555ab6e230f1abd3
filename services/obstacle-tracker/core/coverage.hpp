#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/fleet/coverage.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/time/stamp.hpp"
#include "services/obstacle-tracker/core/scan.hpp"

namespace aisle::obstacle_tracker {

using fleet::CoverageTile;
using fleet::kNeverSeen;
using fleet::kSeenLongAgo;

/// The age of a place as it is sent: the time since it was seen, in steps of half a second, rounded up.
/// @return kNeverSeen for a place never seen, at most kSeenLongAgo for others
inline constexpr double kAgeStep_s = 0.5;

std::uint8_t age_code(time::Stamp seen, time::Stamp now);

/// Which part of the floor the fleet has seen, and when.
///
/// Which cells the lidars of all vehicles observed, and when: a cell that was not observed may hold a mover.
///
/// A coarse cell counts as seen by a scan when every ray towards its middle (a disc of half its size) got as far as its
/// centre. A wall, vehicle or person in front hides it. It claims too little rather than too much: a cell in which a
/// person stands is not seen, but then a track is there; nor is a cell that lies mostly inside a wall.
///
/// Grows with the places that were ever seen: a tile takes 32 KiB, and there are at most 1024. Reads no clock: moments
/// come with the scans.
class Coverage {
 public:
  struct Params {
    double cell_m{0.5};
    double look_every_s{0.4};   // of each vehicle's scans, one in this time is used
    double tell_again_s{10.0};  // a tile without new observations is published again so often

    template <class Reader>
    void describe(Reader& r) {
      r.field("cell_m", cell_m, 0.25, 1.0)
          .field("look_every_s", look_every_s, 0.0, 1.0)
          .field("tell_again_s", tell_again_s, 1.0, 60.0);
    }
  };

  static constexpr int kTileCells = 64;  // edge of a tile
  static constexpr std::size_t kMostTiles = 1024;

  Coverage() = default;
  explicit Coverage(const Params& params) : params_(params) {}

  /// The floor to cover, in map. When it is another one than before, all is forgotten, and the tiles (x, y) published
  /// so far are returned, so that their instances can be ended.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> set_ground(const grid::Geometry& map);

  /// A scan without faults (find_fault() finds none). Does nothing before set_ground().
  void take(const Scan& scan);

  /// The tiles to publish now: those with something seen since they were published, and those published long ago. They
  /// count as published.
  std::vector<CoverageTile> due(time::Stamp now);

 private:
  using Place = std::pair<std::uint32_t, std::uint32_t>;  // tile_x, tile_y

  /// When each of its cells was seen, row by row from the lower left one.
  struct Tile {
    std::vector<time::Stamp> seen;  // kNever: never
    bool has_news{false};
    time::Stamp told{time::Stamp::min()};
  };

  struct Look;

  /// A tile without anything seen; null when there are kMostTiles.
  Tile* new_tile(Place place);

  /// Marks the cells of one tile that the scan sees.
  void look_over(const Look& look, Place place);

  /// Cells along one edge of a tile: fewer at the end of the floor.
  int cells_of(std::uint32_t tile, int ground_cells) const;

  Params params_;
  grid::Geometry map_;
  int width_cells_{0};  // of the ground
  int height_cells_{0};
  std::map<Place, Tile> tiles_;
  std::map<std::string, time::Stamp> looked_;  // stamp of the scan used last, by vehicle
};

}  // namespace aisle::obstacle_tracker
