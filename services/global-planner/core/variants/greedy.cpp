// Greedy best-first search, row G2 (WU names it): the heuristic alone. Few expansions, and no promise about the length.
#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class HeuristicAlone {
 public:
  void begin(const Ends& ends) { goal_ = ends.goal; }
  std::uint32_t operator()(std::uint32_t, grid::Cell cell) const { return octile(cell, goal_); }

 private:
  grid::Cell goal_;
};

}  // namespace

Variant greedy() {
  return {"greedy", "G2: h, octile; few expansions, any length", false,
          [](Parameters&) { return best_first<HeuristicAlone>(Closed::kStay, kDrivableDiagonals, {}); }};
}

}  // namespace aisle::global_planner
