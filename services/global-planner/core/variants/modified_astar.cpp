// "Modified A*", WANG's comparator, row G8: f = g + lg(h + 1) h, h Chebyshev. WANG prints no formula for it; this is
// our reading: its own eq. 4 without the weight by distance.
#include "services/global-planner/core/logged_distance.hpp"
#include "services/global-planner/core/search_parameters.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

template <class Distance>
class Logged {
 public:
  explicit Logged(double log_base) : logged_(log_base) {}
  void begin(const Ends& ends) { logged_.begin(ends); }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const { return evaluated(cost, logged_(cell)); }

 private:
  LoggedDistance<Distance> logged_;
};

}  // namespace

Variant modified_astar() {
  return {"modified-astar", "G8: g + lg(h+1) h, WANG's comparator, no passes", false, [](Parameters& parameters) {
            const double log_base = log_base_of(parameters);
            SearchShape shape = search_shape(parameters, Closed::kStay, "none");
            return with_heuristic(parameters, "chebyshev", [&](auto distance) -> std::unique_ptr<Planner> {
              return best_first(std::move(shape), Logged<decltype(distance)>(log_base));
            });
          }};
}

}  // namespace aisle::global_planner
