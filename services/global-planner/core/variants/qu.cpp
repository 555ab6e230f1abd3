// QU: "log-weighted A* with key nodes" (eq. 4), row G5 with passes P1 and P4: f = g + w h, w = 1 - ln(d_s/d_t + d_t/D),
// h Euclidean. Repaired: as printed w falls without bound at the goal; it is clamped to [0, 1] with d_t at least one
// cell. So it never overestimates: the search finds optimal lengths and expands more cells than A*; QU claims shorter
// and straighter paths, no fewer cells.
// Eq. 3 prints the weight without the logarithm, against eq. 4 and the title: eq. 4 is built. Algorithm 1 puts what is
// reached at a lower cost into the closed list; here it is opened again, or it would never be looked at.
#include <cmath>

#include "services/global-planner/core/search_parameters.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

template <class Distance>
class LogWeighted {
 public:
  LogWeighted(float least_weight, float greatest_weight)
      : least_weight_(least_weight), greatest_weight_(greatest_weight) {}
  void begin(const Ends& ends) {
    start_ = ends.start;
    goal_ = ends.goal;
    per_distance_ = 1.0F / std::max(euclidean_cells(start_, goal_), 1.0F);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    const float to_goal = std::max(euclidean_cells(cell, goal_), 1.0F);
    const float weight = 1.0F - std::log(euclidean_cells(cell, start_) / to_goal + to_goal * per_distance_);
    return evaluated(cost, std::clamp(weight, least_weight_, greatest_weight_) * Distance::cells(cell, goal_));
  }

 private:
  float least_weight_, greatest_weight_;
  grid::Cell start_;
  grid::Cell goal_;
  float per_distance_{0.0F};  // 1/D, in cells
};

}  // namespace

Variant qu() {
  return {"qu", "QU: g + w h, w falling with ln(d_s/d_t + d_t/D), then collinear points and safe lines of sight", false,
          [](Parameters& parameters) {
            const auto least = static_cast<float>(
                parameters.number("least_weight", 0.0, 0.0, 1.0, "of h, where eq. 4 would fall below it"));
            const auto greatest = static_cast<float>(
                parameters.number("greatest_weight", 1.0, 1.0, 100.0, "of h, where eq. 4 would rise above it"));
            SearchShape shape = search_shape(parameters, Closed::kReopen, "collinear,safe-distance");
            return with_heuristic(parameters, "euclidean", [&](auto distance) -> std::unique_ptr<Planner> {
              return best_first(std::move(shape), LogWeighted<decltype(distance)>(least, greatest));
            });
          },
          true};
}

}  // namespace aisle::global_planner
