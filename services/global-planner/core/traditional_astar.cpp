#include "services/global-planner/core/traditional_astar.hpp"

#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"

namespace aisle::global_planner {
namespace {

template <std::uint32_t (*distance)(grid::Cell, grid::Cell)>
class CostAndDistance {
 public:
  void begin(const Ends& ends) { goal_ = ends.goal; }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const { return cost + distance(cell, goal_); }

 private:
  grid::Cell goal_;
};

}  // namespace

std::unique_ptr<Planner> traditional_astar(Heuristic heuristic, Moves moves) {
  const NeighbourRule& rule = moves == Moves::kFour ? kFourNeighbours : kAnyDiagonal;
  switch (heuristic) {
    case Heuristic::kEuclidean:
      return best_first<CostAndDistance<euclidean>>(Closed::kReopen, rule, {});
    case Heuristic::kChebyshev:
      return best_first<CostAndDistance<chebyshev>>(Closed::kReopen, rule, {});
    case Heuristic::kOctile:
      break;
  }

  return best_first<CostAndDistance<octile>>(Closed::kReopen, rule, {});
}

}  // namespace aisle::global_planner
