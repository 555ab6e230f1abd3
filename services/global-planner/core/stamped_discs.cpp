#include "services/global-planner/core/stamped_discs.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::global_planner {
namespace {

/// Does the cell's square touch the disc?
bool touches(const grid::Geometry& geometry, grid::Cell c, const Disc& disc) {
  const geometry::Point2 d = disc.center_in_map - geometry.center_in_map(c);
  const double half_m = 0.5 * geometry.resolution_m;
  return std::hypot(std::max(0.0, std::abs(d.x) - half_m), std::max(0.0, std::abs(d.y) - half_m)) <= disc.radius_m;
}

}  // namespace

StampedDiscs::StampedDiscs(const grid::OccupancyGrid& grid, grid::ClearanceField& clearance,
                           const std::vector<Disc>& discs, const std::vector<std::vector<geometry::Point2>>& polygons)
    : grid_(grid), clearance_(clearance) {
  const grid::Geometry& geometry = grid.geometry();
  std::vector<grid::Cell> stamped;
  for (const Disc& disc : discs) {
    // The square around the disc, within the grid.
    const geometry::Point2 reach{disc.radius_m, disc.radius_m};
    grid::Cell low = geometry.cell_at(disc.center_in_map - reach);
    grid::Cell high = geometry.cell_at(disc.center_in_map + reach);
    low = {std::max(low.x, 0), std::max(low.y, 0)};
    high = {std::min(high.x, geometry.width - 1), std::min(high.y, geometry.height - 1)};

    const std::size_t before = stamped.size();

    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const grid::Cell cell{x, y};
        if (!grid.is_free(cell) || !touches(geometry, cell, disc)) continue;
        stamped.push_back(cell);
      }
    }

    if (stamped.size() > before) windows_.push_back({low, high});
  }

  for (const std::vector<geometry::Point2>& corners : polygons) {
    const std::vector<grid::Cell> cells = grid::cells_touching(geometry, corners);
    if (cells.empty()) continue;

    Window window{cells.front(), cells.front()};
    for (const grid::Cell cell : cells) {
      window.low = {std::min(window.low.x, cell.x), std::min(window.low.y, cell.y)};
      window.high = {std::max(window.high.x, cell.x), std::max(window.high.y, cell.y)};
      if (grid.is_free(cell)) stamped.push_back(cell);
    }
    windows_.push_back(window);
  }

  // All of them first, then the field: windows may overlap, and each must see all cells.
  for (const Window& window : windows_) clearance_.update(grid_, window.low, window.high, stamped);
}

StampedDiscs::~StampedDiscs() {
  for (const Window& window : windows_) clearance_.update(grid_, window.low, window.high);
}

}  // namespace aisle::global_planner
