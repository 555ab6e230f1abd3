// WANG: "distance-and-log weighted A* + turning-point removal" (eq. 4), row G7 with passes P1 and P3.
// f = g + (1 + d_t/D) lg(h + 1) h, h the Chebyshev distance in metres, d_t and D Euclidean distances to the goal from here and from
// the start. lg is log10: below 9 m it makes the heuristic weaker on purpose, so that the search widens near the goal.
#include <cmath>
#include <cstdlib>

#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class DistanceAndLog {
 public:
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    const double from_start = std::hypot(ends.start.x - goal_.x, ends.start.y - goal_.y);
    per_distance_ = static_cast<float>(1.0 / std::max(from_start, 1.0));
    const auto longest = static_cast<std::size_t>(std::max(ends.geometry.width, ends.geometry.height));
    if (logged_.size() == longest && resolution_m_ == ends.geometry.resolution_m) return;
    resolution_m_ = ends.geometry.resolution_m;
    logged_.resize(longest);
    for (std::size_t cells = 0; cells < longest; ++cells) {
      const double h_m = static_cast<double>(cells) * resolution_m_;
      logged_[cells] = static_cast<float>(std::log10(h_m + 1.0) * static_cast<double>(cells) * kStraightCost);
    }
  }

  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    const int dx = std::abs(cell.x - goal_.x);
    const int dy = std::abs(cell.y - goal_.y);
    const float to_goal = std::sqrt(static_cast<float>(dx) * static_cast<float>(dx) + static_cast<float>(dy) * static_cast<float>(dy));
    const float weighted = (1.0F + to_goal * per_distance_) * logged_[static_cast<std::size_t>(std::max(dx, dy))];
    return static_cast<std::uint32_t>(std::min(static_cast<float>(cost) + weighted, 4e9F));
  }

 private:
  grid::Cell goal_;
  float per_distance_{0.0F};     // 1/D, in cells
  std::vector<float> logged_;    // lg(h + 1) h in cost units, by Chebyshev distance in cells
  double resolution_m_{0.0};
};

}  // namespace

Variant wang() {
  return {"wang", "WANG: g + (1 + d_t/D) lg(h+1) h, then collinear points and greedy line of sight", false,
          [] { return best_first<DistanceAndLog>(Closed::kStay, kDrivableDiagonals, {passes::collinear, passes::greedy_line_of_sight}); }};
}

}  // namespace aisle::global_planner
