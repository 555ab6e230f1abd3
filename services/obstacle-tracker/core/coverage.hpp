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

/// The age of a place in steps of half a second, rounded up: it was seen at most so long ago.
inline constexpr double kAgeStep_s = 0.5;
std::uint8_t age_code(time::Stamp seen, time::Stamp now);

/// Which cells the lidars of all vehicles observed, and when: a cell that was not observed may hold a mover.
///
/// A coarse cell counts as seen by a scan when every ray towards its middle (a disc of half its size) got as far as its
/// centre. What stands in front, wall, vehicle or person, hides it. It claims too little rather than too much: a cell
/// that a person stands in is not seen, but then a track is there; nor is one mostly inside a wall.
///
/// Grows with the places that were ever seen: a tile takes 32 KiB, and there are at most 1024. No clock: moments come
/// with the scans.
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

  /// The ground that counts. Another one than before: all is forgotten, and the tiles told so far are returned, to be
  /// disposed.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> set_ground(const grid::Geometry& map);

  /// A scan that was found good (find_fault). Does nothing before set_ground.
  void take(const Scan& scan);

  /// The tiles to tell now: those with something seen since they were told, and those told long ago. They count as
  /// told.
  std::vector<CoverageTile> due(time::Stamp now);

 private:
  using Place = std::pair<std::uint32_t, std::uint32_t>;  // tile_x, tile_y
  struct Tile {
    std::vector<time::Stamp> seen;  // kNever: never
    bool has_news{false};
    time::Stamp told{time::Stamp::min()};
  };
  struct Look;
  Tile* new_tile(Place place);
  void look_over(const Look& look, Place place);
  int cells_of(std::uint32_t tile, int ground_cells) const;

  Params params_;
  grid::Geometry map_;
  int width_cells_{0}, height_cells_{0};  // of the ground
  std::map<Place, Tile> tiles_;
  std::map<std::string, time::Stamp> looked_;
};

}  // namespace aisle::obstacle_tracker
