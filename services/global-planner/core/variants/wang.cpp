// WANG: "distance-and-log weighted A* + turning-point removal" (eq. 4), row G7 with passes P1 and P3.
// f = g + (1 + d_t/D) lg(h + 1) h, d_t and D Euclidean distances to the goal from here and from the start.
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/logged_chebyshev.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class DistanceAndLog {
 public:
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    per_distance_ = 1.0F / std::max(euclidean_cells(ends.start, goal_), 1.0F);
    logged_.begin(ends);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    return evaluated(cost, (1.0F + euclidean_cells(cell, goal_) * per_distance_) * logged_(cell));
  }

 private:
  grid::Cell goal_;
  float per_distance_{0.0F};  // 1/D, in cells
  LoggedChebyshev logged_;
};

}  // namespace

Variant wang() {
  return {"wang", "WANG: g + (1 + d_t/D) lg(h+1) h, then collinear points and greedy line of sight", false, [] {
            return best_first<DistanceAndLog>(Closed::kStay, kDrivableDiagonals,
                                              {passes::collinear, passes::greedy_line_of_sight});
          }};
}

}  // namespace aisle::global_planner
