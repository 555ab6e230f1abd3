// WANG: "distance-and-log weighted A* + turning-point removal" (eq. 4), row G7 with passes P1 and P3.
// f = g + (1 + d_t/D) lg(h + 1) h, d_t and D Euclidean distances to the goal from here and from the start.
// Eq. 2 prints g as the Euclidean distance from the start; g is the cost along the path. Step 2 of its passes prints
// that the search for a line goes on from N_k, which the line did not reach; it goes on from N_(k-1), the point that is
// kept.
#include "services/global-planner/core/logged_distance.hpp"
#include "services/global-planner/core/search_parameters.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

template <class Distance>
class DistanceAndLog {
 public:
  DistanceAndLog(float weight, double log_base) : weight_(weight), logged_(log_base) {}
  void begin(const Ends& ends) {
    goal_ = ends.goal;
    per_distance_ = weight_ / std::max(euclidean_cells(ends.start, goal_), 1.0F);
    logged_.begin(ends);
  }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const {
    return evaluated(cost, (1.0F + euclidean_cells(cell, goal_) * per_distance_) * logged_(cell));
  }

 private:
  float weight_;
  grid::Cell goal_;
  float per_distance_{0.0F};  // weight/D, in cells
  LoggedDistance<Distance> logged_;
};

}  // namespace

Variant wang() {
  return {"wang", "WANG: g + (1 + d_t/D) lg(h+1) h, then collinear points and greedy line of sight", false,
          [](Parameters& parameters) {
            const auto weight = static_cast<float>(
                parameters.number("distance_weight", 1.0, 0.0, 100.0, "of d_t/D beside 1 before h, WANG eq. 4"));
            const double log_base = log_base_of(parameters);
            SearchShape shape = search_shape(parameters, Closed::kStay, "collinear,line-of-sight");
            return with_heuristic(parameters, "chebyshev", [&](auto distance) -> std::unique_ptr<Planner> {
              return best_first(std::move(shape), DistanceAndLog<decltype(distance)>(weight, log_base));
            });
          }};
}

}  // namespace aisle::global_planner
