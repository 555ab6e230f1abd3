// Dijkstra 1959: no heuristic, so every cell nearer than the goal is expanded. Optimal, and the yardstick of the
// others.
#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

struct CostAlone {
  void begin(const Ends&) {}
  std::uint32_t operator()(std::uint32_t cost, grid::Cell) const { return cost; }
};

}  // namespace

Variant dijkstra() {
  return {"dijkstra", "G0: g; optimal on the grid, no passes", true,
          [](Parameters&) { return best_first<CostAlone>(Closed::kStay, kDrivableDiagonals, {}); }};
}

}  // namespace aisle::global_planner
