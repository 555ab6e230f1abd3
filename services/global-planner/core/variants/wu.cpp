// WU: "smoothing A*", row G4 with passes P1, P5 and P6: plain A* with the Euclidean distance, smoothed forwards and
// backwards.
#include "services/global-planner/core/search_parameters.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

template <class Distance>
class CostAndDistance {
 public:
  void begin(const Ends& ends) { goal_ = ends.goal; }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const { return cost + Distance::cost(cell, goal_); }

 private:
  grid::Cell goal_;
};

}  // namespace

Variant wu() {
  return {"wu", "WU: g + h, then collinear points and interpolation forwards and backwards", false,
          [](Parameters& parameters) {
            SearchShape shape =
                search_shape(parameters, Closed::kReopen, "collinear,interpolated-forward,interpolated-backward");
            return with_heuristic(parameters, "euclidean", [&](auto distance) -> std::unique_ptr<Planner> {
              return best_first(std::move(shape), CostAndDistance<decltype(distance)>{});
            });
          },
          true};
}

}  // namespace aisle::global_planner
