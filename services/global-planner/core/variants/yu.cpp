// YU: "weighted-average heuristic and obstacle rate" (eqs. 4, 5), row G6 with passes P1, P3 and P5 at the safe distance
// (2.3): f = g + e^P (h_e + beta h_m) / 2, P the share of obstacle cells in the rectangle between the cell and the
// goal, h_e Euclidean, h_m Manhattan. P costs O(1) a cell by a summed-area table, which costs one pass over the map for
// each search. Algorithm 1 prints g as the Manhattan distance from the start, with which no search finds its way around
// an obstacle; g is the cost along the path. P counts the cells of both ends, so that it is defined in one row or
// column.
#include <cmath>
#include <vector>

#include "services/global-planner/core/search_parameters.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

/// Obstacle cells in the rectangle from (0, 0) to each cell.
class ObstacleCounts {
 public:
  void count(const Drivable& drivable) {
    const grid::Geometry& geometry = drivable.geometry();
    row_ = static_cast<std::size_t>(geometry.width) + 1;
    counts_.assign(row_ * (static_cast<std::size_t>(geometry.height) + 1), 0);
    for (int y = 0; y < geometry.height; ++y) {
      std::uint32_t in_row = 0;
      for (int x = 0; x < geometry.width; ++x) {
        in_row += drivable.is_obstacle({x, y}) ? 1U : 0U;
        counts_[at(x + 1, y + 1)] = counts_[at(x + 1, y)] + in_row;
      }
    }
  }
  /// Share of obstacle cells among those from a to b, both included.
  float rate(grid::Cell a, grid::Cell b) const {
    const grid::Cell low{std::min(a.x, b.x), std::min(a.y, b.y)};
    const grid::Cell high{std::max(a.x, b.x) + 1, std::max(a.y, b.y) + 1};
    const std::uint32_t obstacles = counts_[at(high.x, high.y)] + counts_[at(low.x, low.y)] -
                                    counts_[at(low.x, high.y)] - counts_[at(high.x, low.y)];
    return static_cast<float>(obstacles) / (static_cast<float>(high.x - low.x) * static_cast<float>(high.y - low.y));
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * row_ + static_cast<std::size_t>(x); }
  std::size_t row_{1};
  std::vector<std::uint32_t> counts_;
};

class ObstacleRate {
 public:
  explicit ObstacleRate(float beta) : beta_(beta) {}
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    obstacles_.count(ends.drivable);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    const float average = 0.5F * (euclidean_cells(cell, goal_) + beta_ * manhattan_cells(cell, goal_));
    return evaluated(cost, std::exp(obstacles_.rate(cell, goal_)) * average);
  }

 private:
  float beta_;
  grid::Cell goal_;
  ObstacleCounts obstacles_;
};

}  // namespace

Variant yu() {
  return {"yu",
          "YU: g + e^P (h_e + h_m/2) / 2, P the obstacle rate, then collinear points, lines of sight and "
          "interpolation at a safe distance",
          false, [](Parameters& parameters) {
            const auto beta = static_cast<float>(parameters.number(
                "beta", 0.5, 0.0, 1.0, "share of the Manhattan distance, YU eq. 4: 0 is careful, 1 quick"));
            return best_first(
                search_shape(parameters, Closed::kStay, "collinear,line-of-sight,interpolated-at-safe-distance"),
                ObstacleRate(beta));
          }};
}

}  // namespace aisle::global_planner
