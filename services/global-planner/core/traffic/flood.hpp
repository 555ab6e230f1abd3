#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/floor_bins.hpp"

namespace aisle::global_planner::traffic {

/// Floods the free floor of a window from seeds: each cell learns which seed reaches it first, and the way there.
///
/// Breadth-first over the cells with enough clearance, eight neighbours, cutting no corner.
class Flood {
 public:
  static constexpr std::uint32_t kDry = std::numeric_limits<std::uint32_t>::max();

  /// @param need_m least clearance of a cell; the field must outlive the flood
  Flood(const grid::ClearanceField& clearance, double need_m, const Box& window);

  /// A source at the point, in its cell and the free ones around it. @param label less than kDry
  void seed(geometry::Point2 at_in_map, std::uint32_t label);

  /// Spreads from all seeds that were added since the last call.
  void run();

  /// The seed that reached the cell; kDry: none, or outside the window.
  std::uint32_t label(grid::Cell cell) const { return contains(cell) ? labels_[index(cell)] : kDry; }

  /// From the cell's centre to the seed's point. @pre label(cell) != kDry
  std::vector<geometry::Point2> way_from(grid::Cell cell) const;
  double length_m(grid::Cell cell) const { return length_m_[index(cell)]; }

  /// Could a vehicle stand at the centre of this cell of the window?
  bool is_free(grid::Cell cell) const { return contains(cell) && clearance_.is_traversable(cell, need_m_); }

  grid::Cell low() const { return low_; }
  grid::Cell high() const { return high_; }

 private:
  bool contains(grid::Cell c) const { return c.x >= low_.x && c.y >= low_.y && c.x <= high_.x && c.y <= high_.y; }
  std::size_t index(grid::Cell c) const {
    return static_cast<std::size_t>(c.y - low_.y) * width_ + static_cast<std::size_t>(c.x - low_.x);
  }

  void reach(grid::Cell cell, std::uint32_t label, grid::Cell from, double length_m);

  const grid::ClearanceField& clearance_;
  double need_m_;
  grid::Cell low_;
  grid::Cell high_;
  std::size_t width_{0};

  std::vector<std::uint32_t> labels_;
  std::vector<float> length_m_;
  std::vector<std::uint8_t> came_from_;  // place in kAround, or kSeed
  std::vector<geometry::Point2> seeds_;  // by label
  std::vector<grid::Cell> open_;         // reached, in order
  std::size_t next_{0};                  // of open_, to spread from
};

/// The way with the points left out that a disc of `need_m` can pass by in a straight line. Its ends stay.
std::vector<geometry::Point2> pulled_tight(const grid::ClearanceField& clearance, double need_m,
                                           const std::vector<geometry::Point2>& way_in_map);

}  // namespace aisle::global_planner::traffic
