#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/lab/tracking/trial.hpp"

namespace aisle::tracking {

/// Collects a trial for an SVG: the walls, every person's true way in grey, the ways of one
/// contestant's tracks in colours over it, the vehicles' ways in black.
class Picture {
 public:
  /// Draws the tracks of contestant number `contestant` from begin_s to end_s. @pre `walls` outlives it
  Picture(const grid::OccupancyGrid& walls, std::size_t contestant, double begin_s, double end_s);

  /// One moment; outside the drawn time it is ignored.
  void look(const Glance& now);

  /// The picture's text.
  std::string svg() const;

 private:
  using Ways = std::map<std::uint64_t, std::vector<geometry::Point2>>;

  const grid::OccupancyGrid& walls_;
  std::size_t contestant_;
  double begin_s_, end_s_;
  Ways people_;
  Ways tracks_;
  Ways vehicles_;
};

}  // namespace aisle::tracking
