// LI: "A* with sub-node optimisation" (eq. 9, table I), row G3 with passes P1a and P2: f = g + (1 + d_t/D) h, h
// Euclidean. Repaired: eq. 9 prints r/R with R the distance left, which grows without bound at the goal; the text asks
// for the inverse. Its sub-node rule takes away the diagonals beside a blocked orthogonal neighbour: our rule that no
// corner is cut; every planner of ours has it. Left out: the numbering of cells (eq. 1), which nothing needs, and "9*9
// improved A*" (IV.C), which is explained nowhere.
#include "services/global-planner/core/search_parameters.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

template <class Distance>
class WeightedByDistance {
 public:
  explicit WeightedByDistance(float weight) : weight_(weight) {}
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    per_distance_ = weight_ / std::max(euclidean_cells(ends.start, goal_), 1.0F);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    return evaluated(cost, (1.0F + euclidean_cells(cell, goal_) * per_distance_) * Distance::cells(cell, goal_));
  }

 private:
  float weight_;
  grid::Cell goal_;
  float per_distance_{0.0F};  // weight/D, in cells
};

}  // namespace

Variant li() {
  return {"li", "LI: g + (1 + d_t/D) h, then collinear points but one beside an obstacle, and right angles", false,
          [](Parameters& parameters) {
            const auto weight = static_cast<float>(
                parameters.number("distance_weight", 1.0, 0.0, 100.0, "of d_t/D beside 1 before h, LI eq. 9"));
            SearchShape shape =
                search_shape(parameters, Closed::kStay, "collinear-but-one-beside-obstacles,right-angle");
            return with_heuristic(parameters, "euclidean", [&](auto distance) -> std::unique_ptr<Planner> {
              return best_first(std::move(shape), WeightedByDistance<decltype(distance)>(weight));
            });
          }};
}

}  // namespace aisle::global_planner
