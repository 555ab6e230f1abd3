#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::grid {

/// Column and row; (0, 0) is the lower left cell of the map, y grows upwards.
struct Cell {
  int x{0};
  int y{0};
};

inline bool operator==(Cell a, Cell b) { return a.x == b.x && a.y == b.y; }
inline bool operator!=(Cell a, Cell b) { return !(a == b); }

/// Where a grid lies: `origin_in_map` is the lower left corner of cell (0, 0), axes parallel to the map's.
struct Geometry {
  int width{0};
  int height{0};
  double resolution_m{0.05};
  geometry::Point2 origin_in_map{};

  /// Does the cell lie in the grid?
  bool contains(Cell c) const { return c.x >= 0 && c.y >= 0 && c.x < width && c.y < height; }

  /// Place of the cell in row-major arrays of cells(): y width + x. @pre contains(c)
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c.x);
  }

  /// Number of cells.
  std::size_t cells() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

  /// The middle of the cell, in metres, in map; also of cells outside the grid.
  geometry::Point2 center_in_map(Cell c) const {
    return {origin_in_map.x + (c.x + 0.5) * resolution_m, origin_in_map.y + (c.y + 0.5) * resolution_m};
  }

  /// The cell that holds the point; may lie outside the grid. A point on a border belongs to the cell
  /// above or to the right of it. @pre the point is finite and within 1e9 cells.
  Cell cell_at(geometry::Point2 in_map) const {
    return {static_cast<int>(std::floor((in_map.x - origin_in_map.x) / resolution_m)),
            static_cast<int>(std::floor((in_map.y - origin_in_map.y) / resolution_m))};
  }
};

inline bool operator==(const Geometry& a, const Geometry& b) {
  return a.width == b.width && a.height == b.height && a.resolution_m == b.resolution_m &&
         a.origin_in_map == b.origin_in_map;
}

inline bool operator!=(const Geometry& a, const Geometry& b) { return !(a == b); }

/// What is known of a cell; the numbers are those on the wire and in hashes.
enum class Occupancy : std::uint8_t { kFree = 0, kOccupied = 1, kUnknown = 2 };

/// What stands on the floor: one byte a cell, row by row from the bottom (row-major, index = y width +
/// x). Unknown cells count as blocked for vehicles.
class OccupancyGrid {
 public:
  OccupancyGrid() = default;

  /// Every cell is `fill` at first.
  explicit OccupancyGrid(const Geometry& geometry, Occupancy fill = Occupancy::kFree)
      : geometry_(geometry), cells_(geometry.cells(), fill) {}

  const Geometry& geometry() const { return geometry_; }

  /// @pre the cell lies in the grid; the same for set()
  Occupancy at(Cell c) const { return cells_[geometry_.index(c)]; }
  void set(Cell c, Occupancy o) { cells_[geometry_.index(c)] = o; }

  /// Outside the grid nothing is free.
  bool is_free(Cell c) const { return geometry_.contains(c) && at(c) == Occupancy::kFree; }

  /// All cells, row by row from the bottom.
  const std::vector<Occupancy>& cells() const { return cells_; }

 private:
  Geometry geometry_;
  std::vector<Occupancy> cells_;
};

}  // namespace aisle::grid
