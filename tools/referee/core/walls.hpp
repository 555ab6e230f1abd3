#pragma once

#include <optional>
#include <vector>

#include "common/grid/occupancy_grid.hpp"
#include "tools/referee/core/closest_approach.hpp"

namespace aisle::referee {

/// An axis-parallel box of occupied squares, in map.
struct WallBox {
  geometry::Point2 low;
  geometry::Point2 high;
};

/// The real walls: the occupied squares of the map as it was at the start (edits are rules, not walls),
/// exactly, as boxes of whole cells. Unknown squares and the outside of the map are no walls.
class Walls {
 public:
  explicit Walls(const grid::OccupancyGrid& map);

  /// Least clearance to any wall during one interval; nothing when it is more than kSearch_m all the time.
  std::optional<Approach> closest(const Motion& body) const;
  const std::vector<WallBox>& boxes() const { return boxes_; }
  geometry::Point2 low_in_map() const { return low_; }
  geometry::Point2 high_in_map() const { return high_; }

  static constexpr double kSearch_m = 1.0;

 private:
  /// Fills boxes_.
  void collect_boxes(const grid::OccupancyGrid& map);

  /// Fills bins_, so that closest() looks at few boxes.
  void sort_into_bins();

  std::vector<WallBox> boxes_;
  std::vector<std::vector<std::size_t>> bins_;  // indices of boxes_ that reach into each square of kBin_m, row by row
  int bins_x_{0};
  int bins_y_{0};
  geometry::Point2 low_;
  geometry::Point2 high_;
};

}  // namespace aisle::referee
