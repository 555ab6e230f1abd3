#pragma once

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "bench/peers/peer.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::bench {

/// An entry of the queue: the least f = g + h first.
struct TextbookOpen {
  double f;
  std::size_t index;

  bool operator<(const TextbookOpen& other) const { return f > other.f; }
};

/// Cells from `a` to `b` on an empty grid with diagonal steps: max(dx, dy) + (sqrt(2) - 1) min(dx, dy).
inline double octile_cells(grid::Cell a, grid::Cell b) {
  const double dx = std::abs(a.x - b.x);
  const double dy = std::abs(a.y - b.y);
  return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
}

/// A* as a textbook prints it, to measure ours against in the same run: std::priority_queue, doubles, fresh arrays for
/// each query, octile heuristic, no corner cut, and the path from goal to start at the end.
inline PeerAnswer textbook_astar(const grid::OccupancyGrid& grid, grid::Cell start, grid::Cell goal) {
  const grid::Geometry& geometry = grid.geometry();
  const double diagonal = std::sqrt(2.0);

  PeerAnswer answer;
  std::vector<double> g(geometry.cells(), INFINITY);
  std::vector<bool> closed(geometry.cells(), false);
  std::vector<std::size_t> parent(geometry.cells());
  std::priority_queue<TextbookOpen> open;

  g[geometry.index(start)] = 0.0;
  open.push({octile_cells(start, goal), geometry.index(start)});

  while (!open.empty()) {
    const std::size_t index = open.top().index;
    open.pop();

    if (closed[index]) continue;

    closed[index] = true;

    const grid::Cell at{static_cast<int>(index % static_cast<std::size_t>(geometry.width)),
                        static_cast<int>(index / static_cast<std::size_t>(geometry.width))};
    if (at == goal) {
      std::vector<std::size_t> path;
      for (std::size_t cell = index; cell != geometry.index(start); cell = parent[cell]) path.push_back(cell);
      answer.is_found = !path.empty() || start == goal;
      answer.length_cells = g[index];

      return answer;
    }

    ++answer.expanded;

    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const grid::Cell to{at.x + dx, at.y + dy};
        if ((dx == 0 && dy == 0) || !grid.is_free(to)) continue;
        if (dx != 0 && dy != 0 && (!grid.is_free({at.x + dx, at.y}) || !grid.is_free({at.x, at.y + dy}))) continue;

        const double through = g[index] + (dx != 0 && dy != 0 ? diagonal : 1.0);
        const std::size_t next = geometry.index(to);
        if (through >= g[next]) continue;

        g[next] = through;
        parent[next] = index;
        open.push({through + octile_cells(to, goal), next});
      }
    }
  }

  return answer;
}

}  // namespace aisle::bench
