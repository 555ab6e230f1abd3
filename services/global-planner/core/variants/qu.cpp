// QU: "log-weighted A* with key nodes" (eq. 4), row G5 with passes P1 and P4: f = g + w h, w = 1 - ln(d_s/d_t + d_t/D),
// h Euclidean. Repaired: as printed w falls without bound at the goal; it is clamped to [0, 1] with d_t at least one
// cell. So it never overestimates: the search finds optimal lengths and expands more cells than A*; QU claims shorter
// and straighter paths, no fewer cells.
#include <cmath>

#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class LogWeighted {
 public:
  void begin(const Ends& ends) {
    start_ = ends.start;
    goal_ = ends.goal;
    per_distance_ = 1.0F / std::max(euclidean_cells(start_, goal_), 1.0F);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    const float h = euclidean_cells(cell, goal_);
    const float to_goal = std::max(h, 1.0F);
    const float weight = 1.0F - std::log(euclidean_cells(cell, start_) / to_goal + to_goal * per_distance_);
    return evaluated(cost, std::clamp(weight, 0.0F, 1.0F) * h);
  }

 private:
  grid::Cell start_;
  grid::Cell goal_;
  float per_distance_{0.0F};  // 1/D, in cells
};

}  // namespace

Variant qu() {
  return {
      "qu", "QU: g + w h, w falling with ln(d_s/d_t + d_t/D), then collinear points and safe lines of sight", false,
      [] {
        return best_first<LogWeighted>(Closed::kReopen, kDrivableDiagonals, {passes::collinear, passes::safe_distance});
      },
      true};
}

}  // namespace aisle::global_planner
