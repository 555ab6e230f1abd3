// LI: "A* with sub-node optimisation" (eq. 9, table I), row G3 with passes P1a and P2: f = g + (1 + d_t/D) h, h
// Euclidean. Repaired: eq. 9 prints r/R with R the distance left, which grows without bound at the goal; the text asks
// for the inverse. Its sub-node rule takes away the diagonals beside a blocked orthogonal neighbour: our rule that no
// corner is cut.
#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class WeightedByDistance {
 public:
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    per_distance_ = 1.0F / std::max(euclidean_cells(ends.start, goal_), 1.0F);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    const float to_goal = euclidean_cells(cell, goal_);
    return evaluated(cost, (1.0F + to_goal * per_distance_) * to_goal);
  }

 private:
  grid::Cell goal_;
  float per_distance_{0.0F};  // 1/D, in cells
};

}  // namespace

Variant li() {
  return {"li", "LI: g + (1 + d_t/D) h, then collinear points away from obstacles and right angles", false, [] {
            return best_first<WeightedByDistance>(Closed::kStay, kDrivableDiagonals,
                                                  {passes::collinear_away_from_obstacles, passes::right_angle});
          }};
}

}  // namespace aisle::global_planner
