#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// A square of coarse cells of the floor, and how long ago the fleet's lidars last saw each.
struct CoverageTile {
  std::string source_id;  // instance of the tracker
  std::string map_id;
  std::uint32_t tile_x{0}, tile_y{0};
  geometry::Point2 low_in_map;          // lower left corner of its first cell
  double cell_m{0.5};                   // edge of a cell, above 0, to 100
  int width_cells{0}, height_cells{0};  // each 1 to 4096
  double age_step_s{0.5};               // of the ages below, above 0, to 3600
  std::vector<std::uint8_t> ages;       // width x height, row by row from the bottom, in steps, rounded up
};

/// Ages that are no number of steps.
inline constexpr std::uint8_t kSeenLongAgo = 254;  // this many steps and more
inline constexpr std::uint8_t kNeverSeen = 255;

/// '#' seen in the last second, '+' in the last ten, '.' longer ago, ' ' never.
char letter_of_age(std::uint8_t age, double age_step_s);

/// One letter a cell, the rows as they lie in the map: the uppermost first. Where there are fewer ages than cells, the
/// rows above the last whole one are left out.
std::vector<std::string> picture_of(const std::vector<std::uint8_t>& ages, std::size_t width_cells,
                                    std::size_t height_cells, double age_step_s);

}  // namespace aisle::fleet
