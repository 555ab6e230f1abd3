#include "tools/draw/walls.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace aisle::draw {
namespace {

using grid::Cell;
using grid::Occupancy;

/// The occupancy of the block of cells whose lower left one is `low`.
Occupancy block_at(const grid::OccupancyGrid& grid, Cell low, int edge) {
  bool is_unknown = false;
  for (int y = low.y; y < std::min(low.y + edge, grid.geometry().height); ++y) {
    for (int x = low.x; x < std::min(low.x + edge, grid.geometry().width); ++x) {
      if (grid.at({x, y}) == Occupancy::kOccupied) return Occupancy::kOccupied;
      is_unknown = is_unknown || grid.at({x, y}) == Occupancy::kUnknown;
    }
  }

  return is_unknown ? Occupancy::kUnknown : Occupancy::kFree;
}

/// Cells from `low` up to, without, `high`; what lies beyond the grid is cut off.
Box box_of(const grid::Geometry& g, Cell low, Cell high) {
  const auto corner = [&](Cell c) {
    return g.origin_in_map +
           g.resolution_m * geometry::Point2{double(std::min(c.x, g.width)), double(std::min(c.y, g.height))};
  };

  return {corner(low), corner(high)};
}

}  // namespace

/// Row by row, each run of equal blocks as one box.
GridLayers grid_layers(const grid::OccupancyGrid& grid, int edge) {
  const grid::Geometry& g = grid.geometry();
  GridLayers layers;

  for (int y = 0; y < g.height; y += edge) {
    for (int x = 0; x < g.width;) {
      const Occupancy here = block_at(grid, {x, y}, edge);
      int end = x + edge;

      while (end < g.width && block_at(grid, {end, y}, edge) == here) end += edge;
      if (here == Occupancy::kOccupied) layers.occupied.push_back(box_of(g, {x, y}, {end, y + edge}));
      if (here == Occupancy::kUnknown) layers.unknown.push_back(box_of(g, {x, y}, {end, y + edge}));
      x = end;
    }
  }

  return layers;
}

std::vector<Box> obstacles(const grid::OccupancyGrid& grid) {
  const grid::Geometry& g = grid.geometry();
  std::vector<bool> is_done(g.cells(), false);
  std::vector<Box> boxes;

  // Is the run as free, cell by cell, as the one above it?
  const auto is_same_below = [&](int x0, int x1, int y) {
    for (int x = x0; x < x1; ++x)
      if (y < 0 || grid.is_free({x, y}) != grid.is_free({x, y + 1})) return false;
    return true;
  };

  for (int y = g.height - 1; y >= 0; --y) {
    for (int x = 0; x < g.width; ++x) {
      if (is_done[g.index({x, y})] || grid.is_free({x, y})) continue;

      int end = x, low = y;
      while (end < g.width && !is_done[g.index({end, y})] && !grid.is_free({end, y})) ++end;
      while (is_same_below(x, end, low - 1)) --low;

      for (int done_y = low; done_y <= y; ++done_y)
        for (int done_x = x; done_x < end; ++done_x) is_done[g.index({done_x, done_y})] = true;

      boxes.push_back(box_of(g, {x, low}, {end, y + 1}));
    }
  }

  return boxes;
}

/// One path for all boxes: a closed subpath for each.
std::string boxes_path(const MapFrame& frame, const std::vector<Box>& boxes, Digits digits) {
  std::string d;
  for (const Box& box : boxes) {
    const PointPx upper_left = frame.at({box.low_in_map.x, box.high_in_map.y});
    const double width_px = (box.high_in_map.x - box.low_in_map.x) * frame.px_per_m;
    const double height_px = (box.high_in_map.y - box.low_in_map.y) * frame.px_per_m;
    const char* form =
        digits == Digits::kTenth ? "M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z" : "M{:.5g} {:.5g}h{:.5g}v{:.5g}h{:.5g}z";

    d += fmt::format(fmt::runtime(form), upper_left.x, upper_left.y, width_px, height_px, -width_px);
  }

  return d;
}

}  // namespace aisle::draw
